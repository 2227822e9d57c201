// SPDX-License-Identifier: BSD-3-Clause
// Draws the particles that view.py has put into the page: one camera and one time for all runs, a panel each.
(() => {
  "use strict";
  const box = (id) => document.getElementById(id);
  const told = JSON.parse(box("told").textContent), runs = told.runs;
  const bytes = Uint8Array.from(atob(box("columns").textContent.trim()), (c) => c.charCodeAt(0)).buffer;
  const canvas = box("canvas"), stage = box("stage"), slider = box("time"), colour = box("colour"), walls = box("walls"), play = box("play");
  const CLASSES = ["phase", "body", "material"];
  const HUES = ["#8c959f", "#3d9fd8", "#e8803a", "#2bb58c", "#cc79a7", "#e6b800", "#7a6fd0", "#a3603a", "#56d4c4", "#d0575b"];  // the first: none
  const PHASES = ["#8c959f", "#3d9fd8", "#2bb58c", "#e8803a"];
  const RAMPS = {
    temperature: ["#390963", "#61136e", "#87216b", "#ad305d", "#cf4446", "#ea632a", "#f98b0b", "#fbb81d", "#f2e661"],
    pressure: ["#124984", "#3681ba", "#7eb8d7", "#cae1ee", "#d9d9d9", "#fcd5bf", "#ec9374", "#c84440", "#8a0b25"],
    other: ["#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725"],
  };
  const bits = (hex) => [1, 3, 5].map((n) => parseInt(hex.slice(n, n + 2), 16));
  const GREY = bits(HUES[0]);
  const THIN = 0.4;  // diameter of a wall's particle over its spacing, so that one sees past it

  /// 256 colours of a ramp; pressure is pale at 0 where it has both signs.
  function table(name) {
    const stops = (RAMPS[name] || RAMPS.other).map(bits), [low, high] = told.spans[name], out = new Uint8Array(256 * 3);
    for (let n = 0; n < 256; ++n) {
      let share = n / 255;
      if (name === "pressure" && low < 0 && high > 0) share = 0.5 + 0.5 * (low + share * (high - low)) / Math.max(-low, high);
      const at = Math.min(share * (stops.length - 1), stops.length - 1 - 1e-9), k = Math.floor(at);
      for (let c = 0; c < 3; ++c) out[3 * n + c] = Math.round(stops[k][c] + (at - k) * (stops[k + 1][c] - stops[k][c]));
    }
    return out;
  }
  const hue_of = (name, number) => (name === "phase" ? PHASES[number] : HUES[number === 0 ? 0 : 1 + (number - 1) % (HUES.length - 1)]) || HUES[0];
  const show = (x) => x === 0 ? "0" : Math.abs(x) >= 1e-3 && Math.abs(x) < 1e5 ? String(+x.toPrecision(4)) : x.toExponential(2);

  // --- time: every time that any run wrote
  const end = Math.max(...runs.map((run) => run.times[run.times.length - 1]));
  const times = [];
  for (const t of runs.flatMap((run) => run.times).sort((a, b) => a - b)) if (!times.length || t - times[times.length - 1] > 1e-9 * Math.max(end, 1e-300)) times.push(t);
  const frame_of = (run, t) => { let k = 0; while (k + 1 < run.times.length && run.times[k + 1] <= t + 1e-9 * end) ++k; return k; };
  slider.max = String(times.length - 1);

  // --- the scene of each run
  let renderer;
  try {
    renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
  } catch (error) {
    box("trouble").hidden = false;
    box("trouble").textContent = "This browser gives no WebGL, which draws the particles. Another browser, or `tripoint render RUN`, shows them.";
    return;
  }
  renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
  renderer.setClearColor(0x000000, 0);
  renderer.autoClear = false;
  const camera = new THREE.PerspectiveCamera(32, 1, 0.01, 100);
  const VERTEX = "uniform float diameter, scale; attribute vec3 hue; attribute float part; varying vec3 tint; void main() { vec4 at = modelViewMatrix * vec4(position, 1.0); tint = hue; gl_Position = projectionMatrix * at; gl_PointSize = max(1.5, part * diameter * scale / -at.z); }";
  const FRAGMENT = "varying vec3 tint; void main() { vec2 d = 2.0 * gl_PointCoord - 1.0; float r = dot(d, d); if (r > 1.0) discard; vec3 n = vec3(d.x, -d.y, sqrt(1.0 - r)); float light = 0.5 + 0.5 * max(dot(n, normalize(vec3(-0.35, 0.6, 0.75))), 0.0); gl_FragColor = vec4(tint * light, 1.0); }";
  const panels = runs.map((run) => {
    const n = run.particles, geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * n), 3));
    geometry.setAttribute("hue", new THREE.BufferAttribute(new Uint8Array(3 * n), 3, true));
    geometry.setAttribute("part", new THREE.BufferAttribute(new Float32Array(n), 1));
    const material = new THREE.ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: { diameter: { value: run.spacing }, scale: { value: 1 } } });
    const points = new THREE.Points(geometry, material), scene = new THREE.Scene();
    points.frustumCulled = false;
    scene.add(points);
    const name = document.createElement("div");
    name.className = "name";
    name.append(document.createElement("b"), document.createElement("span"));
    name.firstChild.textContent = run.name;
    stage.append(name);
    const field = (which) => run.fields[which] && { once: run.fields[which].once, values: new Uint16Array(bytes, run.fields[which].at, n * (run.fields[which].once ? 1 : run.times.length)) };
    return { run, n, geometry, material, scene, name, shown: 0, field, place: new Uint16Array(bytes, run.position, 3 * n * run.times.length), wall: new Uint8Array(bytes, run.wall, n) };
  });

  /// Moves the frame's particles into what is drawn; particles that are not there, and walls that are switched off, are left out.
  function fill(panel, k) {
    const { run, n } = panel, position = panel.geometry.attributes.position.array, hue = panel.geometry.attributes.hue.array, part = panel.geometry.attributes.part.array;
    const size = run.high.map((high, c) => (high - run.low[c]) / told.steps), place = panel.place.subarray(3 * n * k, 3 * n * (k + 1)), field = panel.field(colour.value);
    const values = field && (field.once ? field.values : field.values.subarray(n * k, n * (k + 1))), classes = CLASSES.includes(colour.value), ramp = !classes && told.spans[colour.value] ? table(colour.value) : null;
    const hues = classes ? [...Array(65)].map((_, number) => bits(hue_of(colour.value, number))) : null;
    let at = 0;
    for (let i = 0; i < n; ++i) {
      if (place[3 * i] === told.nothing || (!walls.checked && panel.wall[i])) continue;
      for (let c = 0; c < 3; ++c) position[3 * at + c] = run.low[c] + place[3 * i + c] * size[c];
      part[at] = panel.wall[i] ? THIN : 1;
      const value = values ? values[i] : told.nothing;
      if (classes && panel.wall[i]) hue.set(GREY, 3 * at);
      else if (classes && values) hue.set(value < hues.length ? hues[value] : bits(hue_of(colour.value, value)), 3 * at);
      else if (ramp && value !== told.nothing) { const q = 3 * Math.round(255 * value / told.steps); hue[3 * at] = ramp[q]; hue[3 * at + 1] = ramp[q + 1]; hue[3 * at + 2] = ramp[q + 2]; }
      else hue.set(GREY, 3 * at);
      ++at;
    }
    panel.geometry.setDrawRange(0, at);
    panel.geometry.attributes.part.needsUpdate = panel.geometry.attributes.position.needsUpdate = panel.geometry.attributes.hue.needsUpdate = true;
    panel.shown = at;
  }

  // --- the camera: about a point, with up against gravity
  const up = new THREE.Vector3(...runs[0].up);
  const right = Math.abs(up.x) > 0.9 ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(1, 0, 0);
  right.addScaledVector(up, -right.dot(up)).normalize();
  const ahead = new THREE.Vector3().crossVectors(up, right);
  const low = [0, 1, 2].map((c) => Math.min(...runs.map((run) => run.look[0][c]))), high = [0, 1, 2].map((c) => Math.max(...runs.map((run) => run.look[1][c])));
  const middle = new THREE.Vector3(...low.map((x, c) => 0.5 * (x + high[c]))), radius = Math.max(0.5 * Math.hypot(...high.map((x, c) => x - low[c])), 1e-9);
  const eye = { turn: 0, lift: 0, far: 1, at: middle.clone() };
  function whole() { Object.assign(eye, { turn: Math.PI / 6, lift: Math.PI / 9, far: 1 }); eye.at.copy(middle); }
  function place_camera(aspect) {
    const half = Math.tan(camera.fov * Math.PI / 360), distance = eye.far * radius / Math.sin(Math.atan(half * Math.min(1, aspect)));
    camera.aspect = aspect;
    camera.near = Math.max(distance - 6 * radius, 0.01 * distance);
    camera.far = distance + 20 * radius;
    camera.up.copy(up);
    camera.position.copy(eye.at).addScaledVector(right, distance * Math.cos(eye.lift) * Math.sin(eye.turn)).addScaledVector(ahead, -distance * Math.cos(eye.lift) * Math.cos(eye.turn)).addScaledVector(up, distance * Math.sin(eye.lift));
    camera.lookAt(eye.at);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
  }
  function turn(by, lift) { eye.turn -= by; eye.lift = Math.min(Math.max(eye.lift + lift, -1.5), 1.5); draw(); }
  function zoom(by) { eye.far = Math.min(Math.max(eye.far * by, 0.02), 20); draw(); }
  function shift(x, y) {
    const scale = 2 * radius * eye.far / Math.max(1, stage.clientHeight);
    eye.at.addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0), -x * scale).addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 1), y * scale);
    draw();
  }

  // --- drawing: only when something has changed
  let asked = false, filled = "";
  function draw() { if (!asked) { asked = true; requestAnimationFrame(paint); } }
  function layout() {
    const wide = stage.clientWidth, tall = stage.clientHeight, many = panels.length;
    let columns = 1, best = 0;
    for (let c = 1; c <= many; ++c) { const side = Math.min(wide / c, tall / Math.ceil(many / c)); if (side > best * 1.001) { best = side; columns = c; } }
    return { wide, tall, columns, lines: Math.ceil(many / columns) };
  }
  function paint() {
    asked = false;
    const { wide, tall, columns, lines } = layout(), w = wide / columns, h = tall / lines, t = times[+slider.value];
    if (!(wide > 0 && tall > 0)) return;
    const state = `${slider.value} ${colour.value} ${walls.checked}`;
    renderer.setSize(wide, tall, false);
    renderer.setScissorTest(true);
    place_camera(w / h);
    panels.forEach((panel, n) => {
      const k = frame_of(panel.run, t), x = (n % columns) * w, y = Math.floor(n / columns) * h;
      if (state !== filled) fill(panel, k);
      panel.material.uniforms.scale.value = h * renderer.getPixelRatio() / (2 * Math.tan(camera.fov * Math.PI / 360));
      renderer.setViewport(x, tall - y - h, w, h);
      renderer.setScissor(x, tall - y - h, w, h);
      renderer.clear();
      renderer.render(panel.scene, camera);
      panel.name.style.left = `${x}px`;
      panel.name.style.top = `${y}px`;
      panel.name.style.maxWidth = `${w}px`;
      const over = t > panel.run.times[panel.run.times.length - 1] + 1e-9 * end ? ", ended" : "";
      panel.name.lastChild.textContent = `t = ${show(panel.run.times[k])} s${over}, ${panel.shown} particles`;
    });
    filled = state;
    box("now").textContent = `t = ${show(t)} s, frame ${+slider.value + 1} of ${times.length}`;
  }

  function scale() {
    const holder = box("scale"), name = colour.value, words = name.replace("_", " ");
    holder.replaceChildren();
    const part = (kind, text = "") => { const made = document.createElement(kind); made.textContent = text; holder.append(made); return made; };
    if (!name) return;
    if (!CLASSES.includes(name)) {
      const [least, most] = told.spans[name], unit = told.units[name], ramp = table(name), stops = [];
      for (let n = 0; n <= 16; ++n) { const q = 3 * Math.round(255 * n / 16); stops.push(`rgb(${ramp[q]},${ramp[q + 1]},${ramp[q + 2]})`); }
      part("b", words + (unit ? ` [${unit}]` : ""));
      part("div").className = "ramp";
      holder.lastChild.style.background = `linear-gradient(90deg, ${stops.join(", ")})`;
      const ends = part("div");
      ends.className = "ends";
      for (const x of [least, 0.5 * (least + most), most]) ends.append(Object.assign(document.createElement("span"), { textContent: show(x) }));
      return;
    }
    part("b", words);
    const there = new Map();
    for (const panel of panels) {
      const field = panel.field(name);
      const free = field ? field.values.filter((_, i) => !panel.wall[i % panel.n]) : [];
      for (const number of new Set(free)) if (number) there.set(number, (panel.run.labels[name] || [])[number - 1] || `${words} ${number - 1}`); else if (name === "body") there.set(0, "liquid");
    }
    const list = part("div");
    if (runs.some((run) => run.walls)) there.set(-1, "wall");
    for (const [number, label] of [...there].sort((a, b) => a[0] - b[0]).slice(0, 12)) {
      const chip = document.createElement("span"), dot = document.createElement("i");
      chip.className = "chip";
      dot.style.background = number < 0 ? HUES[0] : hue_of(name, number);
      chip.append(dot, label);
      list.append(chip, " ");
    }
    if (there.size > 12) list.append(`and ${there.size - 12} more`);
  }

  // --- what a reader does
  const go = (n) => { slider.value = String(Math.min(Math.max(n, 0), times.length - 1)); draw(); };
  let playing = 0, before = 0;
  const pace = Math.min(Math.max(6000 / times.length, 33), 400);  // [ms] a frame: a round takes about six seconds
  function tick(now) {
    if (!playing) return;
    if (now - before >= pace) { before = now; if (+slider.value + 1 >= times.length) return halt(); go(+slider.value + 1); }
    playing = requestAnimationFrame(tick);
  }
  function halt() { playing = 0; play.textContent = "Play"; play.setAttribute("aria-pressed", "false"); }
  function start() {
    if (playing) return halt();
    if (+slider.value + 1 >= times.length) go(0);
    play.textContent = "Pause";
    play.setAttribute("aria-pressed", "true");
    before = performance.now();
    playing = requestAnimationFrame(tick);
  }
  function recolour() { scale(); draw(); }
  play.addEventListener("click", start);
  slider.addEventListener("input", () => { if (playing) halt(); draw(); });
  colour.addEventListener("change", recolour);
  walls.addEventListener("change", draw);
  box("home").addEventListener("click", () => { whole(); draw(); });
  box("controls").addEventListener("submit", (event) => event.preventDefault());
  new ResizeObserver(draw).observe(stage);

  const fingers = new Map();
  canvas.addEventListener("pointerdown", (event) => { canvas.setPointerCapture(event.pointerId); fingers.set(event.pointerId, [event.clientX, event.clientY]); });
  for (const kind of ["pointerup", "pointercancel"]) canvas.addEventListener(kind, (event) => fingers.delete(event.pointerId));
  canvas.addEventListener("pointermove", (event) => {
    const old = fingers.get(event.pointerId);
    if (!old) return;
    const x = event.clientX - old[0], y = event.clientY - old[1];
    if (fingers.size > 1) {
      const other = [...fingers].find(([id]) => id !== event.pointerId)[1], length = (a) => Math.max(1, Math.hypot(a[0] - other[0], a[1] - other[1]));
      zoom(length(old) / length([event.clientX, event.clientY]));
    } else if (event.buttons & 2 || event.ctrlKey) shift(x, y);
    else turn(0.008 * x, 0.008 * y);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => { event.preventDefault(); zoom(Math.exp(0.0012 * event.deltaY)); }, { passive: false });
  document.addEventListener("keydown", (event) => {
    if (event.metaKey || event.altKey || event.ctrlKey) return;
    const own = event.target.matches("select, button"), bar = event.target === slider, step = 0.12;
    const keys = { " ": start, c: () => { colour.selectedIndex = (colour.selectedIndex + 1) % colour.options.length; recolour(); }, w: () => { walls.checked = !walls.checked; draw(); }, 0: () => { whole(); draw(); }, "+": () => zoom(0.87), "=": () => zoom(0.87), "-": () => zoom(1.15),
      ArrowLeft: () => event.shiftKey ? turn(step, 0) : go(+slider.value - 1), ArrowRight: () => event.shiftKey ? turn(-step, 0) : go(+slider.value + 1), Home: () => go(0), End: () => go(times.length - 1),
      ...(event.shiftKey || !bar ? { ArrowUp: () => turn(0, step), ArrowDown: () => turn(0, -step) } : {}) };
    const does = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!does || (own && (event.key === " " || event.target.matches("select")))) return;
    event.preventDefault();
    if (playing && (event.key.startsWith("Arrow") && !event.shiftKey || event.key === "Home" || event.key === "End")) halt();
    does();
  });

  for (const name of told.order) colour.add(new Option(name.replace("_", " "), name));
  const changing = ["temperature", "phase", "speed"].find((name) => told.order.includes(name) && (name !== "phase" || told.runs.some((run) => !run.fields.phase?.once)));
  colour.value = changing || told.order[0] || "";
  box("walls-box").hidden = !runs.some((run) => run.walls);
  whole();
  scale();
  paint();
})();
