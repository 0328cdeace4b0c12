// Plays a motion: a skeleton at instants, with points, forces, paths and curves (docs/pages.md).
//
// Between two instants bodies are where straight lines between their places lead; quaternions and
// rotations are those of the instant before.
import { SkeletonView, boundsOf, origin, poseWidth } from "arboc/skeleton";

const motion = window.arboc.data.motion;
const $ = (id) => document.getElementById(id);

function check(condition, message) {
  if (!condition) throw new Error(`the motion: ${message}`);
}

function checkMotion() {
  check(motion.format === "arboc-motion/1", `format is ${motion.format}, not arboc-motion/1`);
  const { time, poses, skeleton } = motion;
  check(time?.length > 0 && poses?.length === time.length, "as many poses as instants, at least one");
  time.forEach((t, k) => check(k === 0 || t > time[k - 1], "instants ascend"));
  for (const p of poses) poseWidth(p, skeleton.bodies.length);
  skeleton.bodies.forEach((body, k) => check(body.parent < k, `parent of ${body.name} is before it`));
  for (const curve of motion.curves ?? [])
    check(curve.values.length === time.length, `curve ${curve.name}: a value an instant`);
  for (const force of motion.forces ?? [])
    check(force.at.length === time.length && force.vector.length === time.length,
      `force ${force.name}: a place and a vector an instant`);
}

/// The instant before t, and how far t is towards the next one.
function instant(t) {
  const { time } = motion;
  let low = 0, high = time.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (time[middle] <= t) low = middle;
    else high = middle;
  }
  if (high === low) return { k: 0, part: 0 };
  return { k: low, part: Math.min(Math.max((t - time[low]) / (time[high] - time[low]), 0), 1) };
}

function between(a, b, part) {
  return a.map((x, i) => x + part * (b[i] - x));
}

function posesAt({ k, part }) {
  const { poses, skeleton } = motion;
  const width = poseWidth(poses[k], skeleton.bodies.length);
  if (part === 0) return poses[k];
  const from = width === 12 ? 9 : 0;
  return poses[k].map((x, i) => {
    const j = i % width;
    return j >= from && j < from + 3 ? x + part * (poses[k + 1][i] - x) : x;
  });
}

const SVG = "http://www.w3.org/2000/svg";
function svg(name, attributes, text) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

/// A curve over time with its bounds; returns what moves its cursor.
function plot(curve) {
  const { time } = motion;
  const width = 600, height = 110, left = 60, top = 20;
  const all = [...curve.values, ...[curve.lower, curve.upper].filter((x) => Number.isFinite(x))];
  const low = Math.min(...all), high = Math.max(...all), span = high - low || 1;
  const x = (t) => left + (width - left - 10) * (t - time[0]) / (time.at(-1) - time[0] || 1);
  const y = (value) => top + (height - top - 12) * (1 - (value - low) / span);
  const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, "font-size": 11 });
  picture.append(svg("text", { x: left, y: 12, fill: "#1d2733" }, `${curve.name} (${curve.unit ?? "1"})`));
  for (const value of [low, high])
    picture.append(svg("text", { x: left - 6, y: y(value) + 4, "text-anchor": "end", fill: "#5d6b7a" },
      value.toPrecision(3)));
  for (const bound of [curve.lower, curve.upper].filter((b) => Number.isFinite(b)))
    picture.append(svg("line", { x1: left, x2: width - 10, y1: y(bound), y2: y(bound), stroke: "#c2571a",
      "stroke-dasharray": "4 3" }));
  picture.append(svg("polyline", { fill: "none", stroke: "#1f6fb2", "stroke-width": 1.5,
    points: curve.values.map((value, k) => `${x(time[k]).toFixed(1)},${y(value).toFixed(1)}`).join(" ") }));
  const cursor = svg("line", { y1: top, y2: height - 12, stroke: "#1d2733" });
  picture.append(cursor);
  $("curves").append(picture);
  return (t) => {
    cursor.setAttribute("x1", x(t));
    cursor.setAttribute("x2", x(t));
  };
}

function start() {
  checkMotion();
  const { time, skeleton } = motion;
  $("title").textContent = motion.title ?? document.title;
  $("text").textContent = motion.text ?? "";
  const view = new SkeletonView($("view"), skeleton, boundsOf(motion.poses, skeleton.bodies.length));
  for (const p of motion.points ?? []) view.point(p.position, p.colour);
  for (const p of motion.paths ?? []) view.path(p.positions, p.colour);
  const forces = (motion.forces ?? []).map((force) => ({ force, arrow: view.arrow(force.colour) }));
  const largest = Math.max(1e-12,
    ...forces.flatMap(({ force }) => force.vector.map((v) => Math.hypot(...v))));
  const cursors = (motion.curves ?? []).map(plot);
  let t = time[0], playing = false, last = 0, root = null;

  function show() {
    const at = instant(t);
    const poses = posesAt(at);
    view.show(poses);
    const next = Math.min(at.k + 1, time.length - 1);
    for (const { force, arrow } of forces)
      arrow.set(between(force.at[at.k], force.at[next], at.part),
        between(force.vector[at.k], force.vector[next], at.part)
          .map((x) => x * 0.3 * view.size / largest));
    for (const move of cursors) move(t);
    follow(poses);
    $("time").value = t;
    $("now").textContent = `${t.toFixed(3)} s`;
  }

  /// The camera goes along with the first body.
  function follow(poses) {
    const now = origin(poses, poseWidth(poses, skeleton.bodies.length), 0);
    if (root && $("follow").checked) {
      now.forEach((x, i) => {
        const axis = "xyz"[i];
        view.camera.position[axis] += x - root[i];
        view.controls.target[axis] += x - root[i];
      });
    }
    root = now;
  }

  function play(on) {
    playing = on;
    $("play").textContent = on ? "pause" : "play";
    if (on && t >= time.at(-1)) t = time[0];
    last = performance.now();
    if (on) requestAnimationFrame(step);
  }

  function step(now) {
    if (!playing) return;
    t = Math.min(t + Number($("speed").value) * (now - last) / 1000, time.at(-1));
    last = now;
    show();
    if (t < time.at(-1)) requestAnimationFrame(step);
    else play(false);
  }

  $("time").min = time[0];
  $("time").max = time.at(-1);
  $("time").addEventListener("input", () => {
    play(false);
    t = Number($("time").value);
    show();
  });
  $("play").addEventListener("click", () => play(!playing));
  show();
  window.arboc.view = view;
}

start();
