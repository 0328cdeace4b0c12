// A body in 3-D: a line from each link's frame to the next, its joints, its centres of mass.
//
//   skeleton  {up: [x, y, z], bodies: [{name, parent, mass?, com?, joint?: {type, axis}}]}
//             parent is an index, -1 at the world; parents come before children.  com: m, in the
//             link's frame; axis: unit, in the link's frame, through its origin.
//   poses     per body 12 numbers, the rotation by rows and the origin (as fk.placements has
//             them); or 7, origin and quaternion x y z w; or 3, the origin alone.  m, world axes.
//
// What is drawn is where `poses` says it is: nothing is computed here but where to look from.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const COLOURS = { bone: 0x2f5d8a, lit: 0xc2571a, joint: 0xe0a12b, mass: 0x8393a3, world: 0x9aa7b4 };
const TURNING = new Set(["revolute", "continuous", "unbounded"]);

/// Numbers of each body in a list of poses.
export function poseWidth(poses, bodies) {
  const width = poses.length / bodies;
  if (![3, 7, 12].includes(width))
    throw new Error(`poses hold ${poses.length} numbers for ${bodies} bodies; 3, 7 or 12 a body`);
  return width;
}

export function origin(poses, width, body) {
  const at = body * width + (width === 12 ? 9 : 0);
  return [poses[at], poses[at + 1], poses[at + 2]];
}

/// Lowest and highest corner of what several poses reach.
export function boundsOf(list, bodies) {
  const box = new THREE.Box3();
  for (const poses of list) {
    const width = poseWidth(poses, bodies);
    for (let k = 0; k < bodies; ++k)
      box.expandByPoint(new THREE.Vector3(...origin(poses, width, k)));
  }
  return box;
}

function place(object, poses, width, body) {
  object.position.set(...origin(poses, width, body));
  const at = body * width;
  if (width === 7) object.quaternion.set(...poses.slice(at + 3, at + 7));
  if (width !== 12) return;
  const m = new THREE.Matrix4();
  m.set(poses[at], poses[at + 1], poses[at + 2], 0, poses[at + 3], poses[at + 4], poses[at + 5], 0,
    poses[at + 6], poses[at + 7], poses[at + 8], 0, 0, 0, 0, 1);
  object.quaternion.setFromRotationMatrix(m);
}

/// What bodies are drawn of, each once: a rod of unit length along +y from the origin, of the others
/// what fits a scene of this size.
function shapesOf(size) {
  const r = 0.016 * size;
  return {
    rod: new THREE.CylinderGeometry(0.5 * r, 0.5 * r, 1, 12).translate(0, 0.5, 0),
    knot: new THREE.SphereGeometry(0.6 * r, 16, 10),
    hinge: new THREE.CylinderGeometry(r, r, 2.2 * r, 20),
    slide: new THREE.BoxGeometry(1.2 * r, 3.4 * r, 1.2 * r),
    ball: new THREE.SphereGeometry(1, 20, 12),
  };
}

function stretch(mesh, from, to) {
  const along = to.clone().sub(from);
  const length = along.length();
  mesh.visible = length > 1e-9;
  if (!mesh.visible) return;
  mesh.position.copy(from);
  mesh.scale.set(1, length, 1);
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.divideScalar(length));
}

export class SkeletonView {
  /// Draws into `canvas`, which keeps the size that the page's style gives it; `box` is what should
  /// be in view.  Throws where there is no WebGL.
  constructor(canvas, skeleton, box) {
    this.canvas = canvas;
    this.bodies = skeleton.bodies;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xf6f8fa);
    this.up = new THREE.Vector3(...(skeleton.up ?? [0, 0, 1])).normalize();
    this.size = Math.max(box.getSize(new THREE.Vector3()).length(), 0.1);
    this.shapes = shapesOf(this.size);
    this.#light();
    this.#ground(box);
    this.#build();
    this.#look(box);
    this.dirty = true;
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
    this.renderer.setAnimationLoop(() => this.#frame());
  }

  /// Where everything is now.
  show(poses) {
    const width = poseWidth(poses, this.bodies.length);
    const at = this.bodies.map((_, k) => new THREE.Vector3(...origin(poses, width, k)));
    this.bodies.forEach((body, k) => {
      place(this.frames[k], poses, width, k);
      const bone = this.bones[k];
      if (bone) stretch(bone, body.parent < 0 ? at[k] : at[body.parent], at[k]);
    });
    this.dirty = true;
  }

  /// Looks, from the same side, at what is in a box.
  fit(box) {
    const middle = box.getCenter(new THREE.Vector3());
    const size = Math.max(box.getSize(new THREE.Vector3()).length(), 0.1);
    const from = this.camera.position.clone().sub(this.controls.target).setLength(1.95 * size);
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).add(from);
    this.controls.update();
    this.#seen(middle, size);
    this.dirty = true;
  }

  /// fit(), but only once the box has left the view.
  keepInView(box) {
    const away = box.getCenter(new THREE.Vector3()).distanceTo(this.middle);
    const size = box.getSize(new THREE.Vector3()).length();
    if (away + size / 2 > 0.85 * this.extent) this.fit(box);
  }

  #seen(middle, size) {
    this.middle = middle;
    this.extent = size;
  }

  /// Lights up a body, or none with -1.
  select(body) {
    this.bones.forEach((bone, k) => {
      if (bone) bone.material = k === body ? this.materials.lit : this.materials.bone;
    });
    this.axes.visible = body >= 0;
    if (body >= 0) this.frames[body].add(this.axes);
    this.dirty = true;
  }

  /// A point of the world, as a small ball.
  point(position, colour = COLOURS.lit) {
    const ball = new THREE.Mesh(this.shapes.ball,
      new THREE.MeshLambertMaterial({ color: colour }));
    ball.scale.setScalar(0.016 * this.size);
    ball.position.set(...position);
    this.scene.add(ball);
    this.dirty = true;
    return ball;
  }

  /// An arrow that `set(from, vector)` moves; vector in m of the drawing.
  arrow(colour = COLOURS.lit) {
    const arrow = new THREE.ArrowHelper(new THREE.Vector3(1, 0, 0), new THREE.Vector3(), 1, colour);
    this.scene.add(arrow);
    return {
      set: (from, vector) => {
        const along = new THREE.Vector3(...vector);
        const length = along.length();
        arrow.visible = length > 1e-6 * this.size;
        if (!arrow.visible) return;
        arrow.position.set(...from);
        arrow.setDirection(along.divideScalar(length));
        arrow.setLength(length, Math.min(0.05 * this.size, 0.4 * length), 0.025 * this.size);
        this.dirty = true;
      },
    };
  }

  /// The path of a point: a line through positions.
  path(positions, colour = COLOURS.lit) {
    const line = new THREE.Line(
      new THREE.BufferGeometry().setFromPoints(positions.map((p) => new THREE.Vector3(...p))),
      new THREE.LineBasicMaterial({ color: colour }));
    this.scene.add(line);
    this.dirty = true;
    return line;
  }

  /// Goes round the body until someone takes hold of it.
  set turning(on) {
    this.controls.autoRotate = on;
  }
  get turning() {
    return this.controls.autoRotate;
  }

  #light() {
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0xaab4c0, 2.6));
    const sun = new THREE.DirectionalLight(0xffffff, 1.6);
    sun.position.copy(this.up).add(new THREE.Vector3(0.6, -0.6, 0.3));
    this.scene.add(sun);
  }

  #ground(box) {
    const middle = box.getCenter(new THREE.Vector3());
    const step = 10 ** Math.floor(Math.log10(this.size)) / 2;
    const grid = new THREE.GridHelper(step * 2 * Math.ceil(0.8 * this.size / step),
      2 * Math.ceil(0.8 * this.size / step), 0xb8c2cc, 0xdde3e9);
    grid.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), this.up);
    const low = Math.min(this.up.dot(box.min), this.up.dot(box.max));
    grid.position.copy(middle).addScaledVector(this.up, low - this.up.dot(middle));
    this.scene.add(grid);
  }

  #build() {
    const lambert = (color) => new THREE.MeshLambertMaterial({ color });
    this.materials = { bone: lambert(COLOURS.bone), lit: lambert(COLOURS.lit) };
    const joint = lambert(COLOURS.joint), mass = lambert(COLOURS.mass);
    mass.transparent = true;
    mass.opacity = 0.55;
    const heaviest = Math.max(...this.bodies.map((body) => body.mass ?? 0), 1e-9);
    this.axes = new THREE.AxesHelper(0.12 * this.size);
    this.axes.visible = false;
    this.bones = this.bodies.map((body) => {
      if (body.parent < 0) return null;
      const bone = new THREE.Mesh(this.shapes.rod, this.materials.bone);
      this.scene.add(bone);
      return bone;
    });
    this.frames = this.bodies.map((body) => {
      const frame = new THREE.Group();
      frame.add(new THREE.Mesh(this.shapes.knot, this.materials.bone));
      if (body.joint?.axis) frame.add(this.#joint(body.joint, joint));
      if (body.mass > 0 && body.com) frame.add(this.#mass(body, heaviest, mass));
      this.scene.add(frame);
      return frame;
    });
  }

  /// A short cylinder about the axis of a joint that turns, a box along that of one that slides.
  #joint({ type, axis }, material) {
    const { hinge, slide } = this.shapes;
    const mesh = new THREE.Mesh(TURNING.has(type) ? hinge : slide, material);
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...axis));
    return mesh;
  }

  /// A ball of the link's mass, and a line to it.
  #mass(body, heaviest, material) {
    const group = new THREE.Group();
    const at = new THREE.Vector3(...body.com);
    const ball = new THREE.Mesh(this.shapes.ball, material);
    ball.scale.setScalar(0.03 * this.size * Math.cbrt(body.mass / heaviest));
    ball.position.copy(at);
    const line = new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), at]);
    group.add(ball, new THREE.Line(line, new THREE.LineBasicMaterial({ color: COLOURS.mass })));
    return group;
  }

  #look(box) {
    const middle = box.getCenter(new THREE.Vector3());
    this.camera = new THREE.PerspectiveCamera(35, 1, this.size / 100, 100 * this.size);
    this.camera.up.copy(this.up);
    this.#seen(middle, this.size);
    const side = new THREE.Vector3(1, 0, 0);
    if (Math.abs(side.dot(this.up)) > 0.9) side.set(0, 0, 1);
    side.addScaledVector(this.up, -side.dot(this.up)).normalize();
    const other = this.up.clone().cross(side);
    this.camera.position.copy(middle).addScaledVector(side, 1.5 * this.size)
      .addScaledVector(other, -1.1 * this.size).addScaledVector(this.up, 0.6 * this.size);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target.copy(middle);
    this.controls.autoRotateSpeed = 1.5;
    this.controls.addEventListener("change", () => { this.dirty = true; });
    this.controls.addEventListener("start", () => { this.controls.autoRotate = false; });
    this.controls.update();
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  #frame() {
    this.controls.update();
    if (!this.dirty) return;
    this.dirty = false;
    this.renderer.render(this.scene, this.camera);
    if (this.renderer.info.render.frame === 1) performance.mark("arboc-shown");
  }
}
