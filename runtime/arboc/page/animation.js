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
  const { time, poses, skeleton, format } = motion;
  check(format === "arboc-motion/1", `format is ${format}, not arboc-motion/1`);
  check(time?.length > 0 && poses?.length === time.length, "a pose an instant, at least one");
  time.forEach((t, k) => check(k === 0 || t > time[k - 1], "instants ascend"));
  for (const p of poses) poseWidth(p, skeleton.bodies.length);
  skeleton.bodies.forEach((body, k) =>
    check(body.parent < k, `the parent of ${body.name} comes before it`));
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
  const width = 600, height = 110, left = 60, right = width - 10, top = 20, bottom = height - 12;
  const bounds = [curve.lower, curve.upper].filter((x) => Number.isFinite(x));
  const low = Math.min(...curve.values, ...bounds), high = Math.max(...curve.values, ...bounds);
  const x = (t) => left + (right - left) * (t - time[0]) / (time.at(-1) - time[0] || 1);
  const y = (value) => bottom - (bottom - top) * (value - low) / (high - low || 1);
  const picture = svg("svg", { width, height, viewBox: `0 0 ${width} ${height}`, "font-size": 11 });
  picture.append(svg("text", { x: left, y: 12 }, `${curve.name} (${curve.unit ?? "1"})`));
  for (const value of [low, high])
    picture.append(svg("text", { x: left - 6, y: y(value) + 4, "text-anchor": "end" },
      value.toPrecision(3)));
  for (const value of bounds)
    picture.append(svg("line", { x1: left, x2: right, y1: y(value), y2: y(value),
      stroke: "#c2571a", "stroke-dasharray": "4 3" }));
  const points = curve.values.map((value, k) => `${x(time[k]).toFixed(1)},${y(value).toFixed(1)}`);
  const cursor = svg("line", { y1: top, y2: bottom, stroke: "#1d2733" });
  picture.append(cursor, svg("polyline", { points: points.join(" "), fill: "none",
    stroke: "#1f6fb2", "stroke-width": 1.5 }));
  $("curves").append(picture);
  return (t) => {
    cursor.setAttribute("x1", x(t));
    cursor.setAttribute("x2", x(t));
  };
}

/// Arrows that grow with the forces, the longest 0.3 of the scene; returns what sets them.
function arrows(view) {
  const forces = motion.forces ?? [];
  const sizes = forces.flatMap(({ vector }) => vector.map((v) => Math.hypot(...v)));
  const scale = 0.3 * view.size / Math.max(1e-12, ...sizes);
  const drawn = forces.map((force) => ({ force, arrow: view.arrow(force.colour) }));
  return ({ k, part }) => {
    const next = Math.min(k + 1, motion.time.length - 1);
    for (const { force, arrow } of drawn)
      arrow.set(between(force.at[k], force.at[next], part),
        between(force.vector[k], force.vector[next], part).map((x) => x * scale));
  };
}

class Player {
  constructor() {
    const { skeleton, time } = motion;
    this.bodies = skeleton.bodies.length;
    this.view = new SkeletonView($("view"), skeleton, boundsOf(motion.poses, this.bodies));
    for (const p of motion.points ?? []) this.view.point(p.position, p.colour);
    for (const p of motion.paths ?? []) this.view.path(p.positions, p.colour);
    this.setArrows = arrows(this.view);
    this.cursors = (motion.curves ?? []).map(plot);
    this.playing = false;
    [$("time").min, $("time").max] = [time[0], time.at(-1)];
    this.show(time[0]);
    $("time").addEventListener("input", () => {
      this.play(false);
      this.show(Number($("time").value));
    });
    $("play").addEventListener("click", () => this.play(!this.playing));
  }

  show(t) {
    this.t = t;
    const at = instant(t), poses = posesAt(at);
    this.view.show(poses);
    this.setArrows(at);
    for (const move of this.cursors) move(t);
    this.#follow(origin(poses, poseWidth(poses, this.bodies), 0));
    $("time").value = t;
    $("now").textContent = `${t.toFixed(3)} s`;
  }

  play(on) {
    const { time } = motion;
    this.playing = on;
    $("play").textContent = on ? "pause" : "play";
    if (on && this.t >= time.at(-1)) this.t = time[0];
    this.last = performance.now();
    if (on) requestAnimationFrame((now) => this.#step(now));
  }

  #step(now) {
    if (!this.playing) return;
    const end = motion.time.at(-1);
    this.show(Math.min(this.t + Number($("speed").value) * (now - this.last) / 1000, end));
    this.last = now;
    if (this.t < end) requestAnimationFrame((next) => this.#step(next));
    else this.play(false);
  }

  /// The camera goes along with the first body.
  #follow(now) {
    if (this.root && $("follow").checked) {
      ["x", "y", "z"].forEach((axis, i) => {
        this.view.camera.position[axis] += now[i] - this.root[i];
        this.view.controls.target[axis] += now[i] - this.root[i];
      });
    }
    this.root = now;
  }
}

checkMotion();
$("title").textContent = motion.title ?? document.title;
$("text").textContent = motion.text ?? "";
window.arboc.view = new Player().view;
