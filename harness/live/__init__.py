"""Living people in browsers: seats, visits and the web server. Only this wing knows the web."""
