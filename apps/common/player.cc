#include "page.h"

namespace study {

// Functions without side effects first: `between` finds the frame and the part of the way to the
// next one, `ends_at` interpolates there.  `play` owns the clock and the canvas.
const char* player_script() {
  return R"script(
function between(times, t) {
  let low = 0, high = times.length - 1;
  if (high < 1 || t <= times[0]) return [0, 0];
  if (t >= times[high]) return [high, 0];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return [low, (t - times[low]) / (times[low + 1] - times[low])];
}
function ends_at(segment, frame, part) {
  const ends = segment.ends, out = [];
  if (ends.length === 6) return ends.map(x => x * 1e-4);
  for (let k = 0; k < 6; ++k) {
    const a = ends[6 * frame + k], b = part > 0 ? ends[6 * frame + 6 + k] : a;
    out.push((a + (b - a) * part) * 1e-4);
  }
  return out;
}
function extent(data) {
  const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
  for (const s of data.segments) {
    if (s.kind === 1) continue;  // arrows may be long
    s.ends.forEach((x, k) => {
      low[k % 3] = Math.min(low[k % 3], x * 1e-4);
      high[k % 3] = Math.max(high[k % 3], x * 1e-4);
    });
  }
  const size = Math.max(...low.map((x, k) => high[k] - x), 0.5);
  return {centre: low.map((x, k) => (x + high[k]) / 2), size};
}
// World -> screen: turned about the upright axis, then tipped; in perspective.
function projection(data, view, width, height) {
  const box = data.box || (data.box = extent(data)), up = data.up, a = (up + 1) % 3, b = (up + 2) % 3;
  const distance = 3 * box.size, zoom = view.zoom * 0.8 * Math.min(width, height) / box.size;
  const ct = Math.cos(view.turn), st = Math.sin(view.turn);
  const cp = Math.cos(view.tip), sp = Math.sin(view.tip);
  return (x, y, z) => {
    const p = [x - box.centre[0], y - box.centre[1], z - box.centre[2]];
    const right = ct * p[a] + st * p[b], back = -st * p[a] + ct * p[b];
    const far = cp * back - sp * p[up], high = sp * back + cp * p[up];
    const scale = zoom * distance / Math.max(distance + far, 0.1 * distance);
    return [width / 2 + scale * right, height / 2 - scale * high, scale, far];
  };
}
function draw(context, data, view, frame, part) {
  const width = context.canvas.width, height = context.canvas.height;
  const project = projection(data, view, width, height);
  context.clearRect(0, 0, width, height);
  const lines = data.segments.map(s => {
    const e = ends_at(s, frame, part);
    return {s, from: project(e[0], e[1], e[2]), to: project(e[3], e[4], e[5])};
  });
  lines.sort((x, y) => y.from[3] + y.to[3] - x.from[3] - x.to[3]);  // far ones first
  context.lineCap = "round";
  for (const {s, from, to} of lines) {
    context.beginPath();
    context.moveTo(from[0], from[1]);
    context.lineTo(to[0], to[1]);
    const width = Math.max(1.5, (from[2] + to[2]) * s.radius);
    for (const [colour, wider] of [["#fff", 2], [["#345", "#c30", "#998"][s.kind], 0]]) {
      context.strokeStyle = colour;
      context.lineWidth = width + wider;
      context.stroke();
    }
  }
}
function play(data) {
  const root = document.getElementById("player"), canvas = root.querySelector("canvas");
  const context = canvas.getContext("2d"), [button] = root.getElementsByTagName("button");
  const slider = root.querySelector("input"), speed = root.querySelector("select");
  const text = root.querySelector("span"), view = {turn: 0.6, tip: 0.25, zoom: 1};
  const first = data.times[0], last = data.times[data.times.length - 1];
  let t = first, running = true, before = null, shown = 0, since = 0, rate = 0;
  slider.min = first;
  slider.max = last;
  button.onclick = () => {
    running = !running;
    button.textContent = running ? "pause" : "play";
  };
  slider.oninput = () => { t = +slider.value; };
  canvas.onpointerdown = e => canvas.setPointerCapture(e.pointerId);
  canvas.onpointermove = e => {
    if (!e.buttons) return;
    view.turn += 0.01 * e.movementX;
    view.tip = Math.max(-1.5, Math.min(1.5, view.tip + 0.01 * e.movementY));
  };
  canvas.onwheel = e => {
    view.zoom *= Math.exp(-0.001 * e.deltaY);
    e.preventDefault();
  };
  const lines = [...document.querySelectorAll("line.now")];
  function show(now) {  // ms; called before each refresh of the screen
    if (before !== null && running) {
      t += (now - before) / 1000 * +speed.value;
      if (t > last + 0.5) t = first;  // holds the end for a moment
    }
    before = now;
    if (++shown, now - since > 1000) {
      rate = shown * 1000 / (now - since);
      shown = 0;
      since = now;
    }
    const [frame, part] = between(data.times, t);
    draw(context, data, view, frame, part);
    slider.value = t;
    text.textContent = Math.min(t, last).toFixed(2) + " s, " + rate.toFixed(0) + " pictures a second";
    for (const line of lines) {
      const d = line.dataset, s = (Math.min(t, last) - d.t0) / (d.t1 - d.t0);
      const x = +d.x0 + s * (d.x1 - d.x0);
      line.setAttribute("x1", x);
      line.setAttribute("x2", x);
      line.setAttribute("visibility", s >= 0 && s <= 1 ? "visible" : "hidden");
    }
    requestAnimationFrame(show);
  }
  requestAnimationFrame(show);
}
)script";
}

}  // namespace study
