// Side by side: the pinned settings' numbers, the wipe between any two pictures, and signed error maps.

const pins_most = 8;
const compare = {
  site: null, // whose pictures are shown
  sources: [], // pictures to choose from: { key, label, name, grey }
  left: { picture: "truth", shown: "picture", data: null },
  right: { picture: "", shown: "picture", data: null },
  at: 50, // where the wipe stands, percent from the left
  turn: 0, // of drawing: what was asked for before the last choice is dropped
};

const by_id = id => document.getElementById(id);

// ---- the pinned settings ----

function draw_pinned(pinned, unpin) {
  const keys = ["ms", "fetches", "rmse", "bias", "p99", "max", "ssim", "screen_rmse", "inside", "outside", "noise", "flicker", "instability"];
  const shown = keys.map(key => column_of.get(key));
  const head = make_element("tr", {}, make_element("th", { scope: "col", class: "text" }, "pinned setting"),
    ...shown.map(column => make_element("th", { scope: "col", title: column.about }, column.of_label && !["bias", "ssim"].includes(column.key)
      ? column.of_label.replace("RMSE, depth buffer", "RMSE, depth").replace("silhouettes", "").trim() : column.label)), make_element("th", {}));
  const body = pinned.map(row => make_element("tr", {},
    make_element("th", { scope: "row" }, make_sign_icon(row.technique), make_element("code", {}, row.setting)),
    ...shown.map(column => make_element("td", {}, print_value(column, row))),
    make_element("td", {}, make_element("button", { type: "button", class: "plain", "aria-label": "unpin " + row.setting, title: "unpin", onclick: () => unpin(row.setting) }, "\u00d7"))));
  by_id("pinned").replaceChildren(make_element("thead", {}, head), make_element("tbody", {}, ...body));
  if (body.length === 0) by_id("pinned").append(make_element("tbody", {}, make_element("tr", {},
    make_element("td", { colspan: shown.length + 2, class: "text" }, "Nothing is pinned: click a sign in a chart or a setting in the table."))));
}

// ---- which pictures there are ----

function list_sources(site, candidates) {
  const sources = [];
  const add = (key, label, name, grey) => { if (name && has_picture(name)) sources.push({ key, label, name, grey }); };
  if (site) {
    add("truth", "truth", site.truth, true);
    add("screen", "truth of the depth buffer", site.screen, true);
    add("lit", "lit picture", site.lit, false);
    add("geometry", "geometry mask", site.geometry, true);
  }
  for (const row of candidates) add("setting " + row.setting, row.setting, row.picture, true);
  return sources;
}

function find_source(key) {
  return compare.sources.find(source => source.key === key) || null;
}

function fill_side(side, fallback) {
  const select = by_id(side + "_picture");
  select.replaceChildren(...compare.sources.map(source => new Option(source.label, source.key)));
  if (!find_source(compare[side].picture)) compare[side].picture = fallback;
  select.value = compare[side].picture;
  const shown = by_id(side + "_shown");
  shown.replaceChildren(new Option("picture", "picture"), ...(find_source("truth") ? [new Option("error against truth", "truth")] : []),
    ...(find_source("screen") ? [new Option("error against depth buffer's truth", "screen")] : []));
  if (![...shown.options].some(option => option.value === compare[side].shown)) compare[side].shown = "picture";
  shown.value = compare[side].shown;
}

// ---- the two plates ----

function error_range() {
  return Number(by_id("map_range").value);
}

async function render(source, shown, site) {
  const picture = await read_picture(source.name);
  if (shown === "picture" || !source.grey) return picture;
  const [truth, mask] = await Promise.all([read_site_picture(site, shown), read_site_picture(site, "geometry")]);
  return make_error_map(picture, truth, mask, error_range());
}

function describe_side(side) {
  const source = find_source(compare[side].picture);
  if (!source) return "";
  const as = compare[side].shown === "picture" || !source.grey ? "" : ", " + by_id(side + "_shown").selectedOptions[0].text;
  return source.label + as;
}

async function draw_plates() {
  const turn = ++compare.turn, site = compare.site;
  for (const side of ["left", "right"]) {
    const source = find_source(compare[side].picture);
    const data = source ? await render(source, compare[side].shown, site) : null;
    const grey = source && source.grey ? await read_picture(source.name) : null;
    if (turn !== compare.turn) return;
    compare[side].data = grey;
    show_picture(by_id("plate_" + side), data);
    by_id(side + "_caption").textContent = describe_side(side);
  }
  fit_plates();
  move_wipe(compare.at);
}

function fit_plates() {
  const zoom = Number(by_id("zoom").value), plate = by_id("plate_left"), plates = by_id("plates");
  plates.style.width = zoom ? `${plate.width * zoom}px` : `min(100%, ${2 * plate.width}px)`;
  plates.style.aspectRatio = `${plate.width} / ${plate.height}`;
  by_id("stage").classList.toggle("zoomed", plates.clientWidth > by_id("stage").clientWidth);
}

function move_wipe(percent) {
  compare.at = Math.min(100, Math.max(0, percent));
  by_id("plate_right").style.clipPath = `inset(0 0 0 ${compare.at}%)`;
  const wipe = by_id("wipe");
  wipe.style.left = `${compare.at}%`;
  wipe.setAttribute("aria-valuenow", Math.round(compare.at));
  wipe.setAttribute("aria-valuetext", `${Math.round(compare.at)} percent ${describe_side("left")}, the rest ${describe_side("right")}`);
}

function read_values(event) {
  const plate = by_id("plate_left"), frame = plate.getBoundingClientRect();
  const x = Math.floor((event.clientX - frame.left) / frame.width * plate.width), y = Math.floor((event.clientY - frame.top) / frame.height * plate.height);
  const value_of = data => (data && x >= 0 && y >= 0 && x < data.width && y < data.height ? (data.data[4 * (y * data.width + x)] / 255).toFixed(3) : "-");
  by_id("readout").textContent = `pixel ${x}, ${y}: left ${value_of(compare.left.data)}, right ${value_of(compare.right.data)}`;
}

const wipe_keys = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10, Home: -100, End: 100 };

// The wipe follows the pointer anywhere on the picture; where the picture is larger than its frame, only at its handle: there a
// drag moves the picture.
function listen_to_wipe() {
  const plates = by_id("plates"), stage = by_id("stage");
  let dragging = null;
  const follow = event => {
    const frame = plates.getBoundingClientRect();
    if (dragging.wipes) {
      move_wipe((event.clientX - frame.left) / frame.width * 100);
    } else {
      stage.scrollLeft = dragging.left - (event.clientX - dragging.x);
      stage.scrollTop = dragging.top - (event.clientY - dragging.y);
    }
  };
  plates.addEventListener("pointerdown", event => {
    const wipes = event.target.id === "wipe" || !stage.classList.contains("zoomed");
    if (event.button !== 0 || (!wipes && event.pointerType !== "mouse")) return;
    dragging = { wipes, x: event.clientX, y: event.clientY, left: stage.scrollLeft, top: stage.scrollTop };
    plates.setPointerCapture(event.pointerId);
    if (wipes) by_id("wipe").focus({ preventScroll: true });
    event.preventDefault();
    follow(event);
  });
  plates.addEventListener("pointermove", event => {
    if (dragging) follow(event);
    read_values(event);
  });
  for (const name of ["pointerup", "pointercancel"]) plates.addEventListener(name, () => { dragging = null; });
  by_id("wipe").addEventListener("keydown", event => {
    const step = wipe_keys[event.key];
    if (!step) return;
    move_wipe(compare.at + step * (event.shiftKey ? 10 : 1));
    event.preventDefault();
  });
}

// ---- error maps ----

function draw_legend() {
  const canvas = by_id("legend_scale"), range = error_range(), data = new ImageData(canvas.width, 1);
  for (let x = 0; x < canvas.width; x++) data.data.set([...error_colour(((2 * (x + 0.5)) / canvas.width - 1) * range, range), 255], 4 * x);
  canvas.getContext("2d").putImageData(data, 0, 0);
  by_id("legend_low").textContent = "-" + range;
  by_id("legend_high").textContent = "+" + range;
}

function make_map_figure(row) {
  const canvas = make_element("canvas", { width: 1, height: 1, "data-setting": row.setting });
  const caption = make_element("figcaption", {}, make_sign_icon(row.technique), make_element("code", {}, row.setting));
  return make_element("figure", { class: "map" }, make_element("button", { type: "button", class: "plain", title: "show at the right of the wipe",
    onclick: () => choose_side("right", "setting " + row.setting, by_id("map_against").value) }, canvas), caption);
}

async function draw_maps(pinned) {
  const against = by_id("map_against").value, site = compare.site, maps = by_id("maps");
  const turn = compare.map_turn = (compare.map_turn || 0) + 1;
  draw_legend();
  const shown = pinned.filter(row => find_source("setting " + row.setting));
  maps.replaceChildren(...shown.map(make_map_figure));
  if (!find_source(against) || shown.length === 0) {
    maps.replaceChildren(make_element("p", { class: "note" }, "No pictures of these settings were kept for this camera."));
    return;
  }
  for (const [index, row] of shown.entries()) {
    const source = find_source("setting " + row.setting), data = await render(source, against, site);
    if (turn !== compare.map_turn) return;
    show_picture(maps.querySelectorAll("canvas")[index], data);
    const caption = maps.querySelectorAll("figcaption")[index];
    const column = column_of.get(against === "screen" ? "screen_bias" : "bias"), measured = site_rows_of(row.setting);
    if (data && measured) caption.append(` bias ${print_value(column, measured)}`);
  }
}

function site_rows_of(setting) {
  return compare.rows.find(row => row.setting === setting) || null;
}

// ---- all of it ----

function choose_side(side, picture, shown) {
  compare[side].picture = picture;
  if (shown) compare[side].shown = shown;
  fill_side(side, picture);
  draw_plates();
}

// site_rows: those measured at the site whose pictures are shown; pinned: rows, perhaps summed up over cameras.
function draw_compare(site, site_rows, pinned, unpin) {
  compare.site = site;
  compare.rows = site_rows;
  compare.pinned = pinned;
  compare.sources = list_sources(site, site_rows);
  by_id("pictures_of").textContent = site && compare.sources.length ? `Pictures of ${site.camera}, ${site.width} x ${site.height}.` : "";
  by_id("viewer").hidden = compare.sources.length === 0;
  by_id("no_pictures").hidden = compare.sources.length > 0;
  const first = compare.sources.length ? compare.sources[0].key : "";
  const pinned_picture = pinned.map(row => "setting " + row.setting).find(find_source);
  fill_side("left", first);
  fill_side("right", pinned_picture || first);
  draw_pinned(pinned, unpin);
  draw_plates();
  draw_maps(pinned);
}

function prepare_compare() {
  for (const side of ["left", "right"]) {
    by_id(side + "_picture").addEventListener("change", event => choose_side(side, event.target.value, null));
    by_id(side + "_shown").addEventListener("change", event => choose_side(side, compare[side].picture, event.target.value));
  }
  by_id("zoom").addEventListener("change", fit_plates);
  window.addEventListener("resize", fit_plates);
  by_id("map_against").addEventListener("change", () => draw_maps(compare.pinned));
  by_id("map_range").addEventListener("change", () => {
    draw_maps(compare.pinned);
    draw_plates();
  });
  listen_to_wipe();
}
