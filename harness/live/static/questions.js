// Questionnaires: one instrument a page, or one item a page; with response times; by keyboard, too.
import { el, row, sheet, show } from "./dom.js";

const MOST_MARKS = 21;
const nameOf = (q) => `${q.instrument}.${q.item}`;

// Asks page after page, then calls `done` with every answer; what is left out is null.
// What is entered outlives a reload of the page: `name` says whose questions these are, and which.
export function askQuestions(questions, { page, required }, footer, done, name) {
  const pages = page === "item" ? questions.map((q) => [q]) : byInstrument(questions);
  const draft = draftOf(name);
  const ask = () => {
    if (draft.page >= pages.length) { done(draft.entered); return; }  // again, if it did not arrive
    const title = pages.length > 1 ? `Questions, page ${draft.page + 1} of ${pages.length}` : "Questions";
    askPage(pages[draft.page], { required, footer, title, draft }, (answers) => {
      Object.assign(draft.entered, answers);
      Object.assign(draft, { page: draft.page + 1, fields: {}, seconds: {}, shown: 0 });
      keep(draft);
      ask();
    });
  };
  ask();
}

// One draft at a time, in this tab only: that of other questions, or another person's, is dropped.
const DRAFT = "draft";
function draftOf(name) {
  const kept = JSON.parse(sessionStorage.getItem(DRAFT) || "null");
  if (kept && kept.name === name) return kept;
  forgetDraft();
  return { name, page: 0, entered: {}, fields: {}, seconds: {}, shown: 0 };
}
function keep(draft) { sessionStorage.setItem(DRAFT, JSON.stringify(draft)); }
export function forgetDraft() { sessionStorage.removeItem(DRAFT); }

function byInstrument(questions) {
  const found = new Map();
  for (const q of questions) found.set(q.instrument, [...(found.get(q.instrument) || []), q]);
  return [...found.values()];
}

function askPage(questions, { required, footer, title, draft }, then) {
  const { seconds } = draft;
  let shown = performance.now();
  const problem = el("p", { class: "problem", role: "alert", hidden: true, test: "questions-problem" });
  const fields = questions.map((q) => ({ q, field: fieldOf(q, required) }));
  const form = el("form", {
    novalidate: true,
    oninput: (event) => {
      draft.shown = Math.round(performance.now() - shown);
      seconds[event.target.name] = draft.shown / 1000;
      draft.fields[event.target.name] = event.target.value;
      keep(draft);
    },
    onsubmit: (event) => {
      event.preventDefault();
      const faulty = fields.filter(({ q, field }) => mark(field, faultOf(q, valueOf(form, q), required)));
      if (faulty.length) {
        problem.textContent = faulty.length === 1 ? "One question needs your attention." : `${faulty.length} questions need your attention.`;
        problem.hidden = false;
        faulty[0].field.querySelector("input, textarea").focus();
        return;
      }
      const answers = {};
      for (const q of questions) {
        const name = nameOf(q);
        answers[name] = valueOf(form, q).value;
        if (answers[name] !== null && name in seconds) answers[`${name}#s`] = seconds[name];
      }
      then(answers);
    },
  }, fields.map(({ field }) => field), problem, row(el("button", { test: "questions-submit" }, "Continue")));
  const hint = required ? "Please answer every question." : "You can leave out what you do not want to answer.";
  show(sheet(el("h1", {}, title), el("p", { class: "soft" }, hint), form, footer()));
  for (const [field, value] of Object.entries(draft.fields)) putBack(form.elements[field], value);
  requestAnimationFrame(() => { shown = performance.now() - draft.shown; });
}

function putBack(field, value) {
  field.value = value;  // of radio buttons, this checks the one of that value
  for (const input of field instanceof RadioNodeList ? field : []) {
    input.closest("label").classList.toggle("chosen", input.checked);
  }
}

function valueOf(form, q) {
  const field = form.elements[nameOf(q)];
  const text = field.value;
  if (field.validity && field.validity.badInput) return { value: null, unreadable: true };
  if (q.answer === "text") return { value: text === "" ? null : text };
  return { value: text === "" ? null : Number(text) };
}

function faultOf(q, { value, unreadable }, required) {
  if (unreadable) return `Please enter a number${rangeOf(q)}.`;
  if (value === null) return required ? "Please answer this question." : null;
  if (q.answer !== "number") return null;
  if ((q.lowest !== null && value < q.lowest) || (q.highest !== null && value > q.highest)) return `Please enter a number${rangeOf(q)}.`;
  if (q.step !== null && Math.abs((value - q.lowest) / q.step - Math.round((value - q.lowest) / q.step)) > 1e-9) return `Please enter steps of ${q.step} from ${q.lowest}.`;
  return null;
}

function rangeOf(q) {
  if (q.lowest !== null && q.highest !== null) return ` from ${q.lowest} to ${q.highest}`;
  if (q.lowest !== null) return ` of ${q.lowest} or more`;
  return q.highest !== null ? ` of ${q.highest} or less` : "";
}

function mark(field, fault) {
  const words = field.querySelector(".fault");
  words.textContent = fault || "";
  field.classList.toggle("faulty", Boolean(fault));
  for (const input of field.querySelectorAll("input, textarea")) {
    if (fault) input.setAttribute("aria-invalid", "true"); else input.removeAttribute("aria-invalid");
  }
  return Boolean(fault);
}

function fieldOf(q, required) {
  const id = `q-${nameOf(q)}`, about = `${id}-fault`;
  const shared = { name: nameOf(q), "aria-describedby": about, "aria-required": required ? "true" : null };
  const fault = el("span", { class: "fault", id: about });
  if (q.answer === "point") return scale(q, marksOfScale(q), shared, fault);
  const marks = marksOfNumber(q);
  if (marks) return scale(q, marks, shared, fault);
  const label = el("label", { for: id, class: "question" }, q.text);
  const input = q.answer === "text"
    ? el("textarea", { ...shared, id, rows: "3", maxlength: "2000", test: `answer-${q.item}` })
    : el("input", { ...shared, id, type: "number", step: q.step ?? "any", min: q.lowest, max: q.highest, inputmode: "decimal", test: `answer-${q.item}` });
  return el("div", { class: "field" }, label, input,
    q.answer === "number" && rangeOf(q) ? el("span", { class: "soft" }, `a number${rangeOf(q)}`) : null, fault);
}

function marksOfScale(q) {
  return Array.from({ length: q.points }, (_, i) => [i + 1, q.anchors[i] || String(i + 1)]);
}

// A number in few steps is a line with marks: a slider would stand somewhere before it is touched.
function marksOfNumber(q) {
  if (q.answer !== "number" || q.step === null || q.highest === null) return null;
  const n = Math.round((q.highest - q.lowest) / q.step) + 1;
  if (n > MOST_MARKS) return null;
  return Array.from({ length: n }, (_, i) => { const value = q.lowest + i * q.step; return [value, String(value)]; });
}

function scale(q, marks, shared, fault) {
  const line = el("div", { class: marks.length > 11 ? "scale many" : "scale" }, marks.map(([value, text]) => {
    const input = el("input", { ...shared, type: "radio", value, test: `answer-${q.item}-${value}`, onchange: () => {
      for (const label of line.children) label.classList.toggle("chosen", label.contains(input));
    } });
    return el("label", {}, input, el("span", {}, text));
  }));
  const ends = q.ends ? el("div", { class: "ends", "aria-hidden": "true" }, el("span", {}, q.ends[0]), el("span", {}, q.ends[1])) : null;
  const legend = el("legend", {}, q.text, q.ends ? el("span", { class: "unseen" }, ` From ${q.ends[0]} to ${q.ends[1]}.`) : null);
  return el("fieldset", { class: "field" }, legend, line, ends, fault);
}
