// Builds elements from text only: what others wrote is never read as markup.
export function el(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key === "test") made.dataset.testid = value;
    else if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(key, value);
  }
  for (const child of children.flat(Infinity)) {
    if (child !== null && child !== undefined) made.append(child);
  }
  return made;
}

export function show(...children) {
  const main = document.getElementById("main");
  main.replaceChildren(...children.flat(Infinity));
  const first = main.querySelector("h1, button, input");
  if (first && first.tagName === "H1") { first.tabIndex = -1; first.focus({ preventScroll: true }); }
  window.scrollTo(0, 0);
}

// Headings, lists and paragraphs of Markdown, as elements.
export function prose(text) {
  const parts = [];
  for (const block of text.trim().split(/\n\s*\n/)) {
    const heading = /^(#{1,3})\s+(.*)$/s.exec(block);
    if (heading) { parts.push(el(heading[1].length === 1 ? "h1" : "h2", {}, heading[2])); continue; }
    const lines = block.split("\n");
    if (lines.every((line) => /^\s*[-*]\s+/.test(line))) {
      parts.push(el("ul", {}, lines.map((line) => el("li", {}, line.replace(/^\s*[-*]\s+/, "")))));
    } else parts.push(el("p", {}, lines.join(" ")));
  }
  return parts;
}
