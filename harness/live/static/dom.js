// Builds elements from text only: what others wrote is never read as markup.
const SVG = "http://www.w3.org/2000/svg";

export function el(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

export function svg(name, attributes = {}, ...children) {
  return filled(document.createElementNS(SVG, name), attributes, children);
}

function filled(made, attributes, children) {
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

// Shows something new, and moves the focus to its heading: a screen reader begins there.
export function show(...children) {
  const main = document.getElementById("main");
  main.replaceChildren(...children.flat(Infinity));
  const heading = main.querySelector("h1");
  if (heading) { heading.tabIndex = -1; heading.focus({ preventScroll: true }); }
  window.scrollTo(0, 0);
}

// Says something to a screen reader without moving the focus.
export function announce(text) { document.getElementById("said").textContent = text; }

export function sheet(...children) { return el("section", { class: "sheet" }, children); }
export function row(...children) { return el("div", { class: "row" }, children); }

// Headings, lists, paragraphs, bold, emphasis and links of Markdown, as elements.
export function prose(text) {
  return text.trim().split(/\n\s*\n/).map((block) => {
    const heading = /^(#{1,3})\s+(.*)$/s.exec(block);
    if (heading) return el(heading[1].length === 1 ? "h1" : "h2", {}, inline(heading[2]));
    const lines = block.split("\n");
    for (const [tag, mark] of [["ul", /^\s*[-*]\s+/], ["ol", /^\s*\d+[.)]\s+/]]) {
      if (mark.test(lines[0])) return el(tag, {}, items(lines, mark).map((item) => el("li", {}, inline(item))));
    }
    return el("p", {}, inline(lines.join(" ")));
  });
}

function items(lines, mark) {
  const found = [];
  for (const line of lines) {
    if (mark.test(line)) found.push(line.replace(mark, ""));
    else found[found.length - 1] += ` ${line.trim()}`;
  }
  return found;
}

function inline(text) {
  const parts = [];
  const pattern = /\*\*(.+?)\*\*|\*(.+?)\*|\[([^\]]+)\]\(((?:https:\/\/|mailto:)[^\s)]+)\)/g;
  let last = 0;
  for (const found of text.matchAll(pattern)) {
    parts.push(text.slice(last, found.index));
    const [whole, bold, emphasis, label, address] = found;
    if (bold) parts.push(el("strong", {}, bold));
    else if (emphasis) parts.push(el("em", {}, emphasis));
    else parts.push(el("a", { href: address, target: "_blank", rel: "noreferrer noopener" }, label));
    last = found.index + whole.length;
  }
  parts.push(text.slice(last));
  return parts;
}
