// SPDX-License-Identifier: MIT
'use strict';
// Draws the frames that ViewPage (replay/src/report/view_page.hpp) writes into the page: `run`, what holds for all, and
// `frames`.

const element = id => document.getElementById(id);
const grouped = number => number.toLocaleString('en-US');
const readable = number => String(Number(number.toPrecision(4)));
const counted = (number, thing) => `${grouped(number)} ${thing}${number === 1 ? '' : 's'}`;

// Numbers of a frame.

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

class NumberReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  next() {
    let value = 0, factor = 1;
    for (;; factor *= 128) {
      const byte = this.bytes[this.at++];
      value += (byte & 127) * factor;
      if (byte < 128) return value;
    }
  }
  // Pairs i, j one after the other, from rows of neighbors.
  pairs(rows, count) {
    const pairs = new Int32Array(2 * count);
    let at = 0;
    for (let row = 0; row < rows; ++row) {
      let neighbor = row;
      for (let left = this.next(); left > 0; --left) {
        neighbor += this.next();
        pairs[at++] = row;
        pairs[at++] = neighbor;
      }
    }
    return pairs;
  }
}

function readLevel(reader, facts, lowest) {
  const nodes = new Int32Array(facts.nodes), parents = new Int32Array(facts.nodes);
  let node = 0;
  for (let k = 0; k < facts.nodes; ++k) nodes[k] = lowest ? k : node += reader.next();
  for (let k = 0; k < facts.nodes; ++k) parents[k] = reader.next() - 1;
  return {nodes, parents, edges: lowest ? null : reader.pairs(facts.nodes, facts.edges)};
}

async function readFrame(facts) {
  const reader = new NumberReader(await inflated(facts.data));
  const places = new Float64Array(3 * facts.atoms);
  for (let k = 0; k < places.length; ++k) {
    const low = facts.low[k % 3], high = facts.high[k % 3];
    places[k] = low + (high - low) * reader.next() / 65535;
  }
  const contacts = reader.pairs(facts.atoms, facts.contacts);
  const levels = facts.levels.map((level, i) => readLevel(reader, level, i === 0));
  return {facts, places, contacts, levels};
}

// The node of a level that each atom descends from, by its place among the nodes; -1 for none.
function ancestors(frame, level) {
  const found = Int32Array.from(frame.levels[0].nodes);
  for (let i = 0; i < level; ++i)
    for (let k = 0; k < found.length; ++k)
      if (found[k] >= 0) found[k] = frame.levels[i].parents[found[k]];
  return found;
}

// Places and images.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const plus = (a, b, factor = 1) => [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]];

// Sums of some of the vectors, that of none first.
const sums = vectors => vectors.reduce((all, vector) => all.concat(all.map(sum => plus(sum, vector))), [[0, 0, 0]]);

// The shortest image of a displacement. The periods are reduced: one that none of their sums shortens is it.
function nearest(d, facts, relevant) {
  facts.periods.forEach((period, k) => { d = plus(d, period, -Math.round(dot(facts.duals[k], d))); });
  for (let shorter = true; shorter;) {
    shorter = false;
    for (const sum of relevant)
      for (const sign of [1, -1]) {
        const image = plus(d, sum, sign);
        if (dot(image, image) >= dot(d, d) * (1 - 1e-12)) continue;
        d = image;
        shorter = true;
      }
  }
  return d;
}

const cellOf = facts => sums(facts.periods).map(corner => plus(facts.origin, corner));

// What all frames are moved and shrunk by, so that the first one is about 1 wide.
const scale = (() => {
  let low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const facts of frames.slice(0, 1))
    for (const place of [facts.low, facts.high, ...(facts.periods.length ? cellOf(facts) : [])]) {
      low = low.map((value, axis) => Math.min(value, place[axis]));
      high = high.map((value, axis) => Math.max(value, place[axis]));
    }
  const center = low.map((value, axis) => (value + high[axis]) / 2);
  const size = Math.hypot(...plus(high, low, -1));
  return {center, factor: size > 0 && isFinite(size) ? 1 / size : 1};
})();
const shown = place => plus(place, scale.center, -1).map(value => value * scale.factor);

function linesOf(frame, pairs, places = frame.levels[0].nodes, ends = places) {
  const relevant = sums(frame.facts.periods).slice(1);
  const at = atom => frame.places.subarray(3 * atom, 3 * atom + 3);
  const lines = new Float32Array(3 * pairs.length);
  for (let k = 0; k < pairs.length; k += 2) {
    const begin = at(places[pairs[k]]);
    const step = nearest(plus(at(ends[pairs[k + 1]]), begin, -1), frame.facts, relevant);
    lines.set(shown(begin), 3 * k);
    lines.set(shown(plus(begin, step)), 3 * k + 3);
  }
  return lines;
}

function parentLines(frame, level) {
  const below = frame.levels[level - 1], pairs = [];
  below.parents.forEach((parent, k) => {
    if (parent >= 0 && below.nodes[k] !== frame.levels[level].nodes[parent]) pairs.push(k, parent);
  });
  return linesOf(frame, pairs, below.nodes, frame.levels[level].nodes);
}

function cellLines(facts) {
  const lines = [];
  facts.periods.forEach((period, k) => {
    const others = facts.periods.filter((_, other) => other !== k);
    for (const corner of sums(others)) {
      const begin = plus(facts.origin, corner);
      lines.push(...shown(begin), ...shown(plus(begin, period)));
    }
  });
  return Float32Array.from(lines);
}

// Objects of three.js.

const color = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
// Of a node: the same in all frames.
const nodeColor = atom => new THREE.Color().setHSL(atom * 0.618034 % 1, 0.62, 0.52);

function segments(lines, name, opacity) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(lines, 3));
  return new THREE.LineSegments(geometry,
                                new THREE.LineBasicMaterial({color: color(name), transparent: true, opacity, depthWrite: false}));
}

// A bead in a picture, light from above.
const bead = (() => {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const pen = canvas.getContext('2d');
  const shade = pen.createRadialGradient(26, 22, 2, 32, 32, 31);
  shade.addColorStop(0, '#ffffff');
  shade.addColorStop(0.5, '#dddddd');
  shade.addColorStop(1, '#777777');
  pen.fillStyle = shade;
  pen.arc(32, 32, 31, 0, 2 * Math.PI);
  pen.fill();
  return new THREE.CanvasTexture(canvas);
})();

function atomPoints(frame, level) {
  const count = frame.facts.atoms, places = new Float32Array(3 * count), colors = new Float32Array(3 * count);
  const owners = level > 0 ? ancestors(frame, level) : frame.levels.length ? frame.levels[0].nodes : [];
  for (let atom = 0; atom < count; ++atom) {
    places.set(shown(frame.places.subarray(3 * atom, 3 * atom + 3)), 3 * atom);
    const owner = owners[atom];
    const tint = owner < 0 ? new THREE.Color(0x888888) : nodeColor(frame.levels[level].nodes[owner]);
    colors.set([tint.r, tint.g, tint.b], 3 * atom);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(places, 3));
  geometry.setAttribute('color', new THREE.BufferAttribute(colors, 3));
  const size = Math.min(0.05, 0.55 / Math.cbrt(Math.max(count, 1)));
  return new THREE.Points(geometry, new THREE.PointsMaterial({size, map: bead, alphaTest: 0.5, vertexColors: THREE.VertexColors}));
}

function balls(frame, level) {
  const nodes = frame.levels[level].nodes, radius = frame.facts.levels[level - 1].radius * scale.factor;
  const geometry = nodes.length < 1000 ? new THREE.SphereBufferGeometry(radius, 24, 16) : new THREE.SphereBufferGeometry(radius, 12, 8);
  const mesh = new THREE.InstancedMesh(
      geometry, new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors, transparent: true, opacity: 0.16, depthWrite: false}),
      nodes.length);
  const colors = new Float32Array(3 * nodes.length), matrix = new THREE.Matrix4();
  nodes.forEach((atom, k) => {
    matrix.makeTranslation(...shown(frame.places.subarray(3 * atom, 3 * atom + 3)));
    mesh.setMatrixAt(k, matrix);
    const tint = nodeColor(atom);
    colors.set([tint.r, tint.g, tint.b], 3 * k);
  });
  geometry.setAttribute('color', new THREE.InstancedBufferAttribute(colors, 3));
  mesh.frustumCulled = false;
  return mesh;
}

// The page.

class Viewer {
  constructor() {
    this.renderer = new THREE.WebGLRenderer({canvas: document.querySelector('canvas'), antialias: true, preserveDrawingBuffer: true});
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.005, 50);
    this.camera.position.set(0.55, 0.45, 1.35);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener('change', () => this.draw());
    this.scene = new THREE.Scene();
    this.light = new THREE.DirectionalLight(0xffffff, 0.5);
    this.light.position.set(0.3, 1, 0.5);
    this.objects = new THREE.Group();
    this.scene.add(new THREE.AmbientLight(0xffffff, 0.7), this.light, this.objects);
    this.frame = null;
  }
  resize() {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(innerWidth, innerHeight, false);
    this.camera.aspect = innerWidth / innerHeight;
    const beside = innerWidth > 900 ? 170 : 0;  // the panel
    this.camera.setViewOffset(innerWidth, innerHeight, -beside, 0, innerWidth, innerHeight);
    this.camera.updateProjectionMatrix();
    this.draw();
  }
  draw() {
    this.renderer.setClearColor(color('--page'));
    this.renderer.render(this.scene, this.camera);
  }
  add(object) { this.objects.add(object); }
  clear() {
    for (const object of [...this.objects.children]) {
      this.objects.remove(object);
      object.geometry.dispose();
      object.material.dispose();
    }
  }
  fill(level) {
    const frame = this.frame, wanted = id => element(id).checked;
    this.clear();
    if (frame.facts.atoms === 0) return;
    if (wanted('cell')) this.add(segments(cellLines(frame.facts), '--soft', 0.8));
    if (wanted('contacts')) this.add(segments(linesOf(frame, frame.contacts), '--amber', 0.45));
    if (level > 0 && wanted('edges')) this.add(segments(linesOf(frame, frame.levels[level].edges, frame.levels[level].nodes), '--blue', 0.6));
    if (level > 0 && wanted('parents')) this.add(segments(parentLines(frame, level), '--green', 0.8));
    if (wanted('atoms')) this.add(atomPoints(frame, level));
    if (level > 0 && wanted('balls')) this.add(balls(frame, level));
  }
}

// Frames may have fewer levels than was chosen.
const levelOf = facts => Math.max(0, Math.min(Number(element('level').value), facts.levels.length - 1));

function tell(facts, level) {
  const time = facts.time === null ? '' : `, time ${readable(facts.time)}`;
  element('counts').textContent = `Frame ${grouped(facts.frame)}, step ${grouped(facts.step)}${time}: ` +
      `${counted(facts.atoms, 'atom')}, ${counted(facts.contacts, 'contact')}` +
      (level > 0 ? `; level ${level}: ${counted(facts.levels[level].nodes, 'node')}, ${counted(facts.levels[level].edges, 'edge')}` : '');
  element('meaning').textContent = `Contacts: atoms within ${readable(run.cutoff)} ${run.unit} of each other.` +
      (level > 0 ? ` Balls of radius ${readable(facts.levels[level - 1].radius)} around the nodes of level ${level} hold the nodes of ` +
                   `level ${level - 1} below them. Edges join nodes within ${readable(facts.levels[level].threshold)} of each other. ` +
                   'Atoms have the color of the node that they descend from.' : '');
}

const tellFault = (what, fault) => { element('fault').textContent = `${what}: ${fault.message}`; };

function start() {
  const viewer = new Viewer();
  let ticket = 0, playing = null;

  const refill = () => {
    if (!viewer.frame) return;
    const level = levelOf(viewer.frame.facts);
    viewer.fill(level);
    viewer.draw();
    tell(viewer.frame.facts, level);
    document.body.dataset.shown = element('frame').value;
  };
  const load = async () => {
    const mine = ++ticket;
    try {
      const frame = await readFrame(frames[element('frame').value]);
      if (mine !== ticket) return;  // another frame has been asked for
      viewer.frame = frame;
      refill();
    } catch (fault) {
      tellFault('This frame cannot be shown', fault);
    }
  };
  const play = async () => {
    const slider = element('frame'), mine = playing = {};
    while (playing === mine) {  // not if it was stopped meanwhile, whoever plays now
      slider.value = (Number(slider.value) + 1) % frames.length;
      await load();
      await new Promise(done => setTimeout(done, 100));
    }
  };

  const most = Math.max(...frames.map(facts => facts.levels.length));
  for (let level = 0; level < most; ++level) element('level').add(new Option(level === 0 ? '0: atoms' : level === 1 ? '1: leaves' : level, level));
  element('level').value = Math.min(1, most - 1);
  element('frame').max = frames.length - 1;
  element('frame').addEventListener('input', load);
  element('level').addEventListener('change', refill);
  for (const box of document.querySelectorAll('fieldset input')) box.addEventListener('change', refill);
  element('play').addEventListener('click', () => {
    if (playing) playing = null;
    else play();
    element('play').textContent = playing ? 'stop' : 'play';
  });
  addEventListener('resize', () => viewer.resize());
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', refill);
  viewer.resize();
  load();
}

document.querySelector('h1').textContent = run.source;
try {
  start();
} catch (fault) {
  tellFault('This page needs a browser with WebGL', fault);
}
