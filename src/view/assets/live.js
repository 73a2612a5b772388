"use strict";
// The live view: sand while it is shaped, from the server that the page came from, with the tool, the force on the hand
// and how well the loop keeps its times. Where the page may be the hand (a pointer), it sends back what it draws.

const recordBytes = { head: 80, tile: 4 + 4 * tileSide * tileSide, sample: 24 };
const placed = 2, loadFollows = 8;  // flags: the tool's position is known; the message ends with the sand on it

/** Reads what a server's message says about the tool and the loop; numbers are as on the wire. */
function readHead(bytes) {
  const at = new DataView(bytes);
  const three = (from) => [0, 4, 8].map((i) => at.getFloat32(from + i, true));
  return { tiles: at.getUint32(4, true), time: at.getFloat64(8, true), tip: three(16), force: three(28),
           depth: at.getFloat32(40, true), rate: at.getFloat32(44, true), lateness: at.getFloat32(48, true),
           latest: at.getFloat32(52, true), flags: at.getUint32(56, true),
           turn: [...three(60), at.getFloat32(72, true)] };
}

/** Gives a picture the sand on the tool, as a message has it from a byte on: vertices on the bed's axes from the tip. */
function takeLoad(picture, bytes, from) {
  const [vertices, triangles] = new Uint32Array(bytes, from, 2), first = from + 8;
  picture.setLoad(new Float32Array(bytes, first, 3 * vertices), new Uint32Array(bytes, first + 12 * vertices, 3 * triangles));
}

/** Samples of a pointer as the bytes that are sent. */
function pointerBytes(samples) {
  const bytes = new ArrayBuffer(samples.length * recordBytes.sample), at = new DataView(bytes);
  samples.forEach(({ time, x, y, pressure, switches }, i) => {
    const from = i * recordBytes.sample;
    at.setFloat64(from, time, true);
    [x, y, pressure].forEach((value, k) => at.setFloat32(from + 8 + 4 * k, value, true));
    at.setUint32(from + 20, switches, true);
  });
  return bytes;
}

/** A table of names with numbers that change: set(values). [name, meaning]: the meaning shows under the pointer. */
function numberTable(names) {
  const cells = names.map(() => el("dd", {}, "–")), terms = names.map(([name, title]) => el("dt", { title }, name));
  return { element: el("dl", {}, ...terms.flatMap((term, i) => [term, cells[i]])),
           rename: (from, name, title) => {
             const term = terms.find(({ textContent }) => textContent === from);
             term.textContent = name;
             term.title = title;
           },
           set: (values) => values.forEach((value, i) => { cells[i].textContent = value; }) };
}

const live = { view: null, hello: null, head: null, messages: 0, draws: false, depth: 0.5, ended: false };

/** A button that is pressed or not, as act() returns. */
function switchButton(text, pressed, act) {
  const button = el("button", { type: "button", "aria-pressed": String(pressed), click: () => {
    button.setAttribute("aria-pressed", String(act()));
    live.view.changed();
  } }, text);
  return button;
}

/**
 * The pointer as a hand. While it draws, events with the main button press the tool into the sand: to the chosen depth
 * with mouse or finger, and to twice a pen's pressure times that depth. While a pen is near, fingers are a palm: they do
 * nothing, and one that was down first lets go.
 */
function pointerHand(view, send, depthChanged) {
  const sampleOf = (event, pressed) => {
    const position = view.position(event);
    if (!position) return null;
    const pressure = pressed ? live.depth * (event.pointerType === "pen" ? 2 * event.pressure : 1) : 0;
    return { time: event.timeStamp, x: position[0], y: position[1], pressure: Math.min(pressure, 1), switches: event.buttons };
  };
  let pressed = null, last = null, penIsNear = false;  // pressed: the down event of the pointer that draws
  const tell = (samples) => {
    if (samples.length) send(pointerBytes(samples));
  };
  const lift = (time = performance.now()) => {
    pressed = null;
    if (last) tell([{ ...last, time, pressure: 0, switches: 0 }]);
  };
  const hand = (event) => {
    if (event.pointerType === "pen") penIsNear = event.type !== "pointerleave";
    if (penIsNear && pressed?.pointerType === "touch") lift(event.timeStamp);
    if (penIsNear && event.pointerType === "touch") return true;  // the palm neither draws nor turns
    if (!live.draws || live.ended) return false;
    if (event.type === "wheel") {
      if (pressed === null) return false;
      live.depth = Math.min(Math.max(live.depth * Math.exp(-Math.sign(event.deltaY) * 0.1), 0.05), 1);
      depthChanged();
      return true;
    }
    if (pressed !== null && event.pointerId !== pressed.pointerId) return true;  // one hand holds one tool
    if (event.type === "pointerdown") pressed = event;
    if (event.type === "pointercancel") {  // it may say no position
      lift(event.timeStamp);
      return true;
    }
    if (!(event.buttons & 1)) pressed = null;  // also where the page did not see it let go, or another button holds on
    const events = event.type === "pointermove" ? event.getCoalescedEvents?.() ?? [] : [];
    const samples = (events.length ? events : [event]).map((one) => sampleOf(one, pressed !== null)).filter(Boolean);
    last = samples.at(-1) ?? last;
    // Off the sand's edge the tool is lifted at its last position.
    if (samples.length === 0 && last) samples.push({ ...last, time: event.timeStamp, pressure: 0 });
    tell(samples);
    return true;
  };
  /** Lifts the tool and presses the switch that ends the recording. */
  const finish = () => {
    const { x, y } = last ?? { x: 0, y: 0 }, time = performance.now();
    send(pointerBytes([{ time: time - 50, x, y, pressure: 0, switches: 0 }, { time, x, y, pressure: 0, switches: 2 ** 31 }]));
  };
  return { hand, lift, finish };
}

function drawLive(main) {
  const said = el("p", { class: "said", role: "status" }), title = el("h1", {}, document.title);
  const numbers = numberTable([
    ["time", "since the beginning"], ["depth", "of the tool's tip below the sand around it"],
    ["force", "of the sand on the hand; the arrow shows it"],
    ["loop", "how often a second the device is read; 1000 Hz is usual"],
    ["late by", "how long after its time the last reading came"],
    ["latest", "how late the latest reading of all came"]]);
  const tools = el("div", { class: "corner tools" });
  const frame = el("div", { class: "sand" });
  const help = el("p", {}, viewHelp, " F follows the tool.");
  main.append(frame);
  frame.append(el("div", { class: "corner top" }, title, said), tools,
               el("div", { class: "corner numbers" }, numbers.element),
               el("details", { class: "corner help" }, el("summary", {}, "Mouse and keys"), help));
  const socket = new WebSocket(`${location.origin.replace(/^http/, "ws")}/live${location.search}`);
  socket.binaryType = "arraybuffer";
  const say = (text, now = false) => {
    said.textContent = text;
    said.classList.toggle("now", now);
  };

  const begin = (hello) => {
    live.hello = hello;
    title.textContent = hello.title;
    document.title = `${hello.title} – sand, live`;
    const { rows, cols, cell_size: cellSize, x0, y0, low, high, bottom, pointer } = hello;
    const span = Math.max(high - low, 0.01);
    const view = sandView({ rows, cols, cellSize, x0, y0, low: low - span / 2, high: high + span / 2, bottom }, "Live sand");
    if (!view) {
      frame.prepend(el("p", { class: "warning" }, "This browser has no WebGL 2, so it shows numbers, but no sand."));
      return;
    }
    live.view = view;
    if (hello.tool.vertices) view.picture.setToolMesh(hello.tool.vertices, hello.tool.triangles.flat());
    frame.prepend(view.canvas, view.scale);
    view.canvas.focus({ preventScroll: true });
    const colour = switchButton("Colours by height", false, view.act.colour);
    const follow = switchButton("Follow the tool", false, view.act.follow);
    const all = el("button", { type: "button", click: () => { view.act.all(); view.changed(); } }, "Show all");
    tools.append(colour, follow, all);
    view.acted = () => {   // by a key, too
      colour.setAttribute("aria-pressed", String(view.coloured));
      follow.setAttribute("aria-pressed", String(view.follows));
    };
    if (!pointer) return;
    live.draws = true;
    numbers.rename("force", "force (not felt)", "a device would give this force to the hand; a pointer gives none");
    const depth = el("input", { type: "range", min: 0.05, max: 1, step: 0.01, value: live.depth,
                                "aria-label": "depth of the tool",
                                input: (event) => { live.depth = Number(event.target.value); } });
    const draw = switchButton("Draw", true, () => {
      live.draws = !live.draws;
      lift();
      return view.canvas.classList.toggle("draws", live.draws);
    });
    view.canvas.classList.add("draws");
    const { hand, lift, finish } = pointerHand(view, (bytes) => socket.readyState === 1 && socket.send(bytes),
                                         () => { depth.value = live.depth; });
    tools.append(el("br"), draw, el("label", {}, "Depth", depth),
                 el("button", { type: "button", class: "finish", click: finish }, "Finish"));
    help.prepend("Press and drag to draw in the sand; the wheel then sets the depth. A pen goes there at half its " +
                 "pressure, and deeper with more. Drag with the right button to turn the view. D turns drawing off " +
                 "and on; while it is off, the main button turns the view, too. ");
    view.drawing = hand;
    view.canvas.addEventListener("keydown", (event) => {
      if (event.key.toLowerCase() === "d") draw.click();
    });
  };

  const takePicture = (bytes) => {
    const head = readHead(bytes), { view } = live;
    live.head = head;
    live.messages += 1;
    const { flags, force, depth } = head, newtons = lengthOf(force);
    numbers.set([`${head.time.toFixed(2)} s`, Number.isFinite(depth) ? `${withMinus((1e3 * depth).toFixed(2))} mm` : "–",
                 `${newtons.toFixed(2)} N`, `${head.rate.toFixed(0)} Hz`, `${(1e6 * head.lateness).toFixed(0)} µs`,
                 `${(1e6 * head.latest).toFixed(0)} µs`]);
    if (!view) return;
    let at = recordBytes.head;
    for (let i = 0; i < head.tiles; i += 1, at += recordBytes.tile) {
      const tile = new DataView(bytes).getUint32(at, true), values = new Float32Array(bytes, at + 4, tileSide * tileSide);
      const { tileCount } = view.picture;
      if (tile < tileCount) view.picture.setTile(tile, values);
      else view.picture.setFloorTile(tile - tileCount, values);
    }
    if (flags & loadFollows) takeLoad(view.picture, bytes, at);
    const { tool, max_force: most } = live.hello;
    const long = (0.25 * view.picture.size) / (most > 0 && most < 1e3 ? most : 10);
    const shown = flags & placed ? { tip: head.tip, turn: head.turn, radius: tool.radius, force: force.map((x) => x * long) } : null;
    if (head.tiles === 0 && !(flags & loadFollows) && JSON.stringify(shown) === JSON.stringify(view.tool)) return;
    view.tool = shown;
    view.changed();
  };

  socket.onmessage = ({ data }) => {
    if (typeof data !== "string") return takePicture(data);
    const { hello, status, end, drawing } = JSON.parse(data);
    if (hello) begin(hello);
    if (status !== undefined) say(status, status !== "");
    if (drawing === false && live.hello?.pointer) say("another page holds the tool; this one only watches");
    if (drawing === true) say("");
    if (end !== undefined) {
      live.ended = true;
      say(`Ended: ${end}.`);
    }
  };
  socket.onclose = () => {
    if (!live.ended) say("The connection is closed: the command has ended, or cannot be reached.", true);
    live.ended = true;
  };
}

drawPage((data, main) => drawLive(main));
