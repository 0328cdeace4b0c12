// The report of a model: tables from the data of the page, and its skeleton, moved by sliders.
//
// Where links are is what the generated function fk says, and the forces beside the sliders are
// those of the generated gravity; both are modules of this page.
import { fk } from "arboc/fk";
import { gravity } from "arboc/gravity";
import { SkeletonView, boundsOf } from "arboc/skeleton";

const { model, skeleton, controls, links, diagnostics, operations, matrices, cost } =
  window.arboc.data.report;
const $ = (id) => document.getElementById(id);

function element(name, properties = {}, ...children) {
  const made = Object.assign(document.createElement(name), properties);
  made.append(...children);
  return made;
}
const cell = (text, className = "") => element("td", { className }, `${text}`);
const head = (text, className = "") => element("th", { className }, text);
const number = (text) => cell(text, "number");

// The configuration, and what functions make of it.
const q = new Float64Array(model.nq);
const placements = new Float64Array(12 * skeleton.bodies.length);
const forces = new Float64Array(model.nv);
const shown = [];  // called when q has changed
let view = null;

function update() {
  fk(q, placements);
  if (gravity) gravity(q, forces);
  for (const f of shown) f();
  if (!view) return;
  view.show(Array.from(placements));
  view.keepInView(bounds());
}

const bounds = () => boundsOf([Array.from(placements)], skeleton.bodies.length);

function quaternion(roll, pitch, yaw) {
  const [a, b, c] = [roll / 2, pitch / 2, yaw / 2];
  const [sa, sb, sc] = [a, b, c].map(Math.sin), [ca, cb, cc] = [a, b, c].map(Math.cos);
  return [sa * cb * cc - ca * sb * sc, ca * sb * cc + sa * cb * sc,
    ca * cb * sc - sa * sb * cc, ca * cb * cc + sa * sb * sc];
}

const TURNS = [["roll", -Math.PI, Math.PI], ["pitch", -Math.PI / 2, Math.PI / 2],
  ["yaw", -Math.PI, Math.PI]];
const PLACES = (reach) => ["x", "y", "z"].map((axis) => [axis, -reach, reach, true]);

/// Sliders of a joint, [label, lower, upper, whether it goes anywhere], and how their values become
/// coordinates.
function sliders({ type, lower, upper }) {
  const one = (low, high, free) => [["q", lower ?? low, upper ?? high, free && lower === null]];
  const copy = (x) => x;
  const reach = Math.max(1, model.reach);
  switch (type) {
    case "prismatic": return { of: one(-reach, reach, true), q: copy };
    case "unbounded": return { of: one(-Math.PI, Math.PI), q: ([x]) => [Math.cos(x), Math.sin(x)] };
    case "planar": return { of: [...PLACES(reach).slice(0, 2), TURNS[2]], q: copy };
    case "spherical": return { of: TURNS, q: (x) => quaternion(...x) };
    case "floating": return { of: [...PLACES(reach), ...TURNS],
      q: (x) => [...x.slice(0, 3), ...quaternion(...x.slice(3))] };
    default: return { of: one(-Math.PI, Math.PI), q: copy };
  }
}

const resets = [];  // each takes a function (lower, upper, anywhere) -> value
function addJoint(control) {
  const { of, q: coordinates } = sliders(control);
  const values = [], inputs = [], outputs = [];
  const force = element("span", { className: "soft number" });
  const box = element("div", { className: "joint" }, element("div", { className: "head" },
    element("span", { className: "name", title: control.name }, control.name), force));
  const apply = () => {
    coordinates(values).forEach((x, k) => { q[control.q + k] = x; });
    values.forEach((x, k) => { outputs[k].textContent = x.toFixed(3); });
  };
  of.forEach(([label, lower, upper], k) => {
    const input = element("input", { type: "range", step: "any", min: lower, max: upper });
    input.setAttribute("aria-label", `${control.name} ${label}`);
    input.addEventListener("input", () => {
      values[k] = Number(input.value);
      apply();
      update();
    });
    inputs.push(input);
    outputs.push(element("output", { className: "number" }));
    box.append(element("div", { className: "row" }, element("span", { className: "soft" }, label),
      input, outputs[k]));
  });
  resets.push((choose) => {
    of.forEach(([, lower, upper, anywhere], k) => {
      values[k] = choose(lower, upper, anywhere);
      inputs[k].value = values[k];
    });
    apply();
  });
  if (gravity && control.nv === 1) shown.push(() => {
    force.textContent = `${forces[control.v].toFixed(2)} ${control.unit}`;
    force.title = "the force that holds the body at rest here";
  });
  $("joints").append(box);
}

function fillHead() {
  document.title = $("name").textContent = model.name;
  $("summary").textContent = `${links.length} links, ${model.nv} degrees of freedom, ` +
    `${Number(model.mass.toPrecision(6))} kg, gravity (${model.gravity.join(", ")}) m/s²`;
  $("origin").textContent = `${model.file}, SHA-256 ${model.sha256.slice(0, 16)}…; ` +
    `arboc ${model.version}` + (model.options.length ? `; ${model.options.join(" ")}` : "");
}

let lit = -1;
function light(k) {
  lit = lit === k ? -1 : k;
  [...$("links").querySelectorAll("tr.link")].forEach((row, i) => {
    row.classList.toggle("lit", i === lit);
  });
  if (view) view.select(lit);
}

function fillLinks() {
  $("links").append(element("tr", {}, ...["link", "joint", "type", "on"].map((t) => head(t)),
    ...["mass, kg", "x", "y", "z"].map((t) => head(t, "number")), head("remarks")));
  links.forEach((link, k) => {
    const at = ["x", "y", "z"].map(() => number(""));
    const remarks = diagnostics.filter(
      (d) => d.severity !== "note" && d.element.includes(`'${link.name}'`)).map((d) => d.message);
    const row = element("tr", { className: "link" },
      ...[link.name, link.joint, link.type, link.parent].map((text) => cell(text)),
      number(Number(link.mass.toPrecision(6))), ...at, cell(remarks.join("; ")));
    row.addEventListener("click", () => light(k));
    $("links").append(row);
    shown.push(() => at.forEach((x, i) => {
      const value = placements[12 * k + 9 + i];
      x.textContent = value.toFixed(4);
      x.title = `${value}`;
    }));
  });
}

function fillDiagnostics() {
  if (diagnostics.length === 0) {
    $("warnings").replaceWith(element("p", { id: "warnings" }, "None."));
    return;
  }
  const table = element("table", {}, element("tr", {},
    ...["", "where", "what", "message", "remedy"].map((t) => head(t))));
  for (const d of diagnostics)
    table.append(element("tr", {}, cell(d.severity, `severity-${d.severity}`),
      cell(d.line ? `${d.file}:${d.line}:${d.column}` : d.file), cell(d.element), cell(d.message),
      cell(d.hint)));
  $("warnings").append(table);
}

function fillOperations() {
  if (operations.absent.length)
    $("operations-text").append(` Left out: ${operations.absent.join("; ")}.`);
  const table = $("operations"), functions = operations.functions;
  table.append(element("tr", {}, head("link"), ...functions.map((f) => head(f.name, "number"))));
  for (const row of operations.rows)
    table.append(element("tr", {}, cell(row.name), ...row.counts.map((n) => number(n || ""))));
  const sum = (title, of) => table.append(element("tr", {}, head(title),
    ...functions.map((f) => head(`${of(f) ?? ""}`, "number"))));
  sum("all", (f) => f.total);
  sum("limbs in lanes", (f) => f.lanes);
  sum("sines with cosines", (f) => f.sincos);
}

function fillMatrices() {
  const SVG = "http://www.w3.org/2000/svg";
  for (const matrix of matrices) {
    const n = matrix.size, side = Math.max(3, Math.min(24, 330 / n));
    const picture = document.createElementNS(SVG, "svg");
    const set = (e, attributes) => {
      for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
      return e;
    };
    set(picture, { width: n * side, height: n * side, viewBox: `0 0 ${n} ${n}` });
    matrix.row.forEach((row, k) => {
      const square = set(document.createElementNS(SVG, "rect"),
        { x: matrix.col[k] + 0.04, y: row + 0.04, width: 0.92, height: 0.92, fill: "#1f6fb2" });
      const title = document.createElementNS(SVG, "title");
      title.textContent = `${model.velocities[row]}, ${model.velocities[matrix.col[k]]}`;
      square.append(title);
      picture.append(square);
    });
    $("matrices").append(element("figure", {}, element("figcaption", {},
      `${matrix.name}: ${matrix.row.length} of ${n * n} entries`), picture));
  }
  if (matrices.length === 0) $("matrices").textContent = "The model has no masses.";
}

function fillCost() {
  $("cost-text").append(` ${cost.s_per_file} s of CPU a file and ${cost.ms_per_operation} ms an ` +
    `operation, by ${cost.compiler}.`);
  $("cost").append(element("tr", {}, head("function"), head("operations", "number"),
    head("CPU, s", "number")));
  for (const f of cost.functions)
    $("cost").append(element("tr", {}, cell(f.name), number(f.operations),
      number(f.seconds.toFixed(2))));
}

function startView() {
  try {
    view = new SkeletonView($("view"), skeleton, bounds());
  } catch (error) {
    $("note").textContent = `No 3-D here: ${error.message}`;
    return;
  }
  view.show(Array.from(placements));
  view.turning = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  $("turn").addEventListener("click", () => { view.turning = !view.turning; });
}

function reset(choose) {
  for (const f of resets) f(choose);
  update();
  if (view) view.fit(bounds());
}
const home = (lower, upper) => Math.min(Math.max(0, lower), upper);

fillHead();
controls.forEach(addJoint);
fillLinks();
fillDiagnostics();
fillOperations();
fillMatrices();
fillCost();
reset(home);
startView();
$("reset").addEventListener("click", () => reset(home));
$("random").addEventListener("click", () =>
  reset((lower, upper, anywhere) => anywhere ? 0 : lower + Math.random() * (upper - lower)));
Object.assign(window.arboc, { view, q: () => Array.from(q), forces: () => Array.from(forces) });
