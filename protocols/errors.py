"""The one exception that means: it is your input, and here is what to change."""


class InputError(Exception):
    """Something a person gave cannot be used.

    The message is one line that says where, what and what is allowed. The command line prints it
    and exits with 2; nothing is overwritten or left half-written.
    """
