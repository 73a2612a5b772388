"use strict";
// Looks at sand (sand.js) with mouse, finger, pen and keys: turns, shifts, zooms, colours, and follows the tool.

/** A camera on a sphere about a target; angles in radians, azimuth from +x towards +y. */
function orbitCamera(bed, size) {
  const start = { azimuth: (-70 * Math.PI) / 180, elevation: (42 * Math.PI) / 180, distance: 2.1 * size,
                  target: [bed.x0 + ((bed.cols - 1) * bed.cellSize) / 2, bed.y0 + ((bed.rows - 1) * bed.cellSize) / 2,
                           (bed.low + bed.high) / 2] };
  const tan = Math.tan((17.5 * Math.PI) / 180);
  const now = { ...start };
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
  const of = (aspect) => {
    const { azimuth, elevation, target } = now;
    const distance = now.distance * Math.max(1, 1.25 / aspect);
    const forward = [-Math.cos(elevation) * Math.cos(azimuth), -Math.cos(elevation) * Math.sin(azimuth),
                     -Math.sin(elevation)];
    const right = [-Math.sin(azimuth), Math.cos(azimuth), 0], up = cross(right, forward);
    return { eye: plus(target, forward, -distance), forward, right, up, tan, aspect, distance };
  };
  return {
    of,
    turn: (right, up) => {
      now.azimuth -= right;
      now.elevation = clamp(now.elevation + up, 0.02, Math.PI / 2 - 1e-3);
    },
    /** Shifts by fractions of the picture's height. */
    shift: (right, up) => {
      const camera = of(1), metres = 2 * tan * camera.distance;
      const ahead = [-Math.cos(now.azimuth), -Math.sin(now.azimuth), 0];
      now.target = plus(plus(now.target, camera.right, -right * metres), ahead, up * metres);
      now.target = now.target.map((x, i) => clamp(x, start.target[i] - 0.6 * size, start.target[i] + 0.6 * size));
    },
    zoom: (factor) => { now.distance = clamp(now.distance * factor, 0.06 * size, 4 * size); },
    look: (at) => { now.target = [...at]; },
    reset: () => Object.assign(now, start, { target: [...start.target] }),
    /** Eye and direction through a position in the picture (x, y from -1 to 1, y up). */
    ray: (x, y, aspect) => {
      const camera = of(aspect);
      return [camera.eye, unitOf(plus(plus(camera.forward, camera.right, x * tan * aspect), camera.up, y * tan))];
    },
    state: now,
  };
}

const viewHelp = "Drag to turn, Shift+drag to shift; the wheel zooms. Keys: arrows turn, Shift+arrows shift, + and − " +
  "zoom, C colours by height, Home shows all.";

/**
 * A view of a bed; null where it cannot be drawn. It has canvas; picture (sandPicture): call changed() when it changed;
 * position(event): the position on the sand under the pointer; and drawing: a function that takes pointer events of the main
 * button instead of turning, and then returns true.
 */
function sandView(bed, label) {
  const canvas = el("canvas", { tabindex: "0", role: "img", "aria-label": `${label}. ${viewHelp}` });
  const picture = sandPicture(canvas, bed);
  if (!picture) return null;
  const camera = orbitCamera(bed, picture.size);
  const view = { canvas, picture, camera, follows: false, coloured: false, drawing: null, pictures: 0,
                 tool: null, colours: null };
  let waiting = false, rested = 0;

  // The scale of the colours, while there are any.
  view.scale = el("div", { class: "scale", hidden: true });
  let said = null;
  const sayColours = (colouring) => {
    if (said?.low === colouring?.low && said?.high === colouring?.high) return;
    said = colouring;
    view.scale.hidden = !colouring;
    if (!colouring) return;
    const { low, high, diverging = false } = colouring;
    const stops = palettes[diverging ? "diverging" : "sequential"]
      .map((colour) => `rgb(${colour.map((part) => Math.round(255 * part))})`);
    const text = (height) => `${withMinus((1e3 * height).toPrecision(3))} mm`;
    view.scale.replaceChildren(text(low), el("span", { style: `background: linear-gradient(to right, ${stops})` }), text(high));
  };

  // Where pictures take long, they are coarser while something moves, and a full one follows. No picture is begun
  // before the last one is done: it would only wait in a queue.
  const pace = { coarseness: picture.fast ? 1 : 2, mean: 20, busy: false };  // mean [ms]: the time of a picture
  view.pace = pace;
  const takePace = (took) => {
    pace.mean += 0.2 * (Math.min(took, 80) - pace.mean);  // a picture that took very long says little
    if (pace.mean > 31 && pace.coarseness < 4) [pace.coarseness, pace.mean] = [pace.coarseness * 1.15, 28];
    if (pace.mean < 25 && pace.coarseness > 1) [pace.coarseness, pace.mean] = [Math.max(1, pace.coarseness / 1.1), 28];
  };
  const drawAtPace = (coarseness) => {
    const begun = performance.now();
    waiting = false;
    pace.busy = true;
    clearTimeout(rested);
    drawNow(coarseness);
    const look = () => {
      if (picture.isBusy()) return setTimeout(look, 2);
      pace.busy = false;
      if (coarseness === pace.coarseness) takePace(performance.now() - begun);
      if (waiting) requestAnimationFrame(() => drawAtPace(pace.coarseness));
      else if (coarseness > 1) rested = setTimeout(drawAtPace, 300, 1);
    };
    setTimeout(look, 2);
  };

  const drawNow = (coarseness = 1) => {
    const scale = Math.min(devicePixelRatio, 2) / coarseness, { clientWidth, clientHeight } = canvas;
    const [width, height] = [clientWidth, clientHeight].map((length) => Math.max(1, Math.round(length * scale)));
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    if (view.follows && view.tool) camera.look(view.tool.tip);
    picture.setTool(view.tool);
    const colouring = view.coloured ? view.colours ?? { values: null, low: bed.low, high: bed.high } : null;
    picture.setColours(colouring);
    sayColours(colouring);
    picture.draw(camera, coarseness);
    view.pictures += 1;
  };
  view.changed = () => {
    if (waiting) return;
    waiting = true;
    if (!pace.busy) requestAnimationFrame(() => drawAtPace(pace.coarseness));
  };
  view.drawNow = drawNow;
  view.act = {
    colour: () => (view.coloured = !view.coloured),
    follow: () => (view.follows = !view.follows),
    all: () => {
      view.follows = false;
      camera.reset();
      view.acted?.();
    },
  };

  // ---- The pointer. Its position is where a ray through it meets the sand.
  const fractionsOf = (event) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    return [(2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height, width / height];
  };
  view.position = (event) => picture.meet(camera.ray(...fractionsOf(event)));

  const pressed = new Map();  // pointers that turn, shift or zoom, by id
  const step = (event) => {
    const before = pressed.get(event.pointerId), others = [...pressed.values()].filter((one) => one !== before);
    const height = canvas.clientHeight;
    const [right, down] = [(event.clientX - before.x) / height, (event.clientY - before.y) / height];
    if (others.length > 0) {
      const apart = ({ x, y }) => Math.hypot(x - others[0].x, y - others[0].y) + 1;
      camera.zoom(apart(before) / apart({ x: event.clientX, y: event.clientY }));
      camera.shift(right / 2, -down / 2);
    } else if (event.shiftKey || before.shifts) {
      camera.shift(right, down);
    } else {
      camera.turn(2.5 * right, 2.5 * down);
    }
    Object.assign(before, { x: event.clientX, y: event.clientY });
    view.changed();
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    event.preventDefault();
    if (event.button === 5) return;  // a pen's eraser: there is nothing to erase
    canvas.setPointerCapture(event.pointerId);  // until it is let go, wherever it goes
    const mayDraw = pressed.size === 0 || event.pointerType === "touch";
    if (event.button === 0 && !event.shiftKey && mayDraw && view.drawing?.(event)) return;
    pressed.set(event.pointerId, { x: event.clientX, y: event.clientY, shifts: event.button === 1 });
  });
  canvas.addEventListener("pointermove", (event) => {
    if (pressed.has(event.pointerId)) step(event);
    else view.drawing?.(event);
  });
  for (const name of ["pointerup", "pointercancel"])
    canvas.addEventListener(name, (event) => {
      if (!pressed.delete(event.pointerId)) view.drawing?.(event);
    });
  canvas.addEventListener("pointerleave", (event) => { view.drawing?.(event); });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    if (view.drawing?.(event)) return;
    camera.zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) * 2e-3));
    view.changed();
  }, { passive: false });

  // ---- Keys.
  const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turn = turns[event.key];
    const { colour, follow, all } = view.act, closer = () => camera.zoom(0.85), away = () => camera.zoom(1 / 0.85);
    const act = { c: colour, f: follow, Home: all, "+": closer, "=": closer, "-": away }[
      event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (turn && event.shiftKey) camera.shift(-0.05 * turn[0], -0.05 * turn[1]);
    else if (turn) camera.turn(0.1 * turn[0], 0.1 * turn[1]);
    else if (act) act();
    else return;
    event.preventDefault();
    view.acted?.();
    view.changed();
  });
  new ResizeObserver(view.changed).observe(canvas);
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  return view;
}
