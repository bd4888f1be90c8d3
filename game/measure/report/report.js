// The choices at the top, and what follows from them.

const choice = { scene: "", camera: "", reach: "", error: "rmse", hidden: new Set(), pins: [] };
let charts = {};

function row_of_choice(setting) {
  return choice.rows.find(row => row.setting === setting) || null;
}

function error_value(row) {
  const column = column_of.get(choice.error);
  return column.of(row[column.key]);
}

// ---- choices ----

function fill_select(id, options, value) {
  const select = by_id(id);
  select.replaceChildren(...options.map(([key, label]) => new Option(label, key)));
  select.value = options.some(([key]) => key === value) ? value : options.length ? options[0][0] : "";
  return select.value;
}

// Each choice offers what there is for those before it, and keeps what was chosen where it can.
function fill_choices() {
  choice.scene = fill_select("scene", unique(rows.map(row => row.scene)).map(scene => [scene, scene]), choice.scene);
  const of_scene = rows.filter(row => row.scene === choice.scene);
  const cameras = unique(of_scene.map(row => row.camera));
  const all = cameras.length > 1 ? [["", `all ${cameras.length} cameras`]] : [];
  choice.camera = fill_select("camera", [...cameras.map(camera => [camera, camera]), ...all], choice.camera);
  const of_camera = of_scene.filter(row => choice.camera === "" || row.camera === choice.camera);
  const reaches = new Map(of_camera.map(row => [row.reach_key, row.reach]));
  choice.reach = fill_select("reach", [...reaches], choice.reach);
  choice.error = fill_select("error", error_columns.filter(column => rows.some(row => Number.isFinite(row[column.key]))).map(column => [column.key, error_label(column)]), choice.error) || "rmse";
}

function make_technique_choice(technique) {
  const button = make_element("button", { type: "button", "aria-pressed": "true", title: "show or hide in the charts", onclick: () => {
    if (!choice.hidden.delete(technique)) choice.hidden.add(technique);
    button.setAttribute("aria-pressed", String(!choice.hidden.has(technique)));
    draw_charts();
  } }, make_sign_icon(technique), technique);
  return button;
}

// ---- pins ----

function pin(row) {
  if (choice.pins.includes(row.setting)) {
    unpin(row.setting);
    return;
  }
  choice.pins = [...choice.pins, row.setting].slice(-pins_most);
  compare.right.picture = "setting " + row.setting;
  draw_chosen();
}

function unpin(setting) {
  choice.pins = choice.pins.filter(pinned => pinned !== setting);
  draw_chosen();
}

// To the place of a row, with its setting pinned and at the right of the wipe.
function go(row) {
  const moved = row.scene !== choice.scene || row.reach_key !== choice.reach || (choice.camera !== "" && row.camera !== choice.camera);
  Object.assign(choice, { scene: row.scene, reach: row.reach_key });
  if (moved) choice.camera = row.camera;
  if (!choice.pins.includes(row.setting)) choice.pins = [...choice.pins, row.setting].slice(-pins_most);
  compare.right.picture = "setting " + row.setting;
  update();
  by_id("compare_heading").scrollIntoView({ block: "start" });
}

// ---- drawing ----

function sites_of_choice() {
  const seen = new Set(rows.filter(row => row.scene === choice.scene && row.reach_key === choice.reach && (choice.camera === "" || row.camera === choice.camera)).map(site_of_row));
  return report.sites.filter(site => seen.has(site));
}

async function draw_charts() {
  const error = column_of.get(choice.error), turn = choice.chart_turn = (choice.chart_turn || 0) + 1;
  const options = { rows: choice.rows.filter(row => row.technique !== reference_technique && !choice.hidden.has(row.technique)), error, pinned: choice.pins, screen_error: NaN };
  const draw = () => {
    charts = {
      chart_ms: draw_chart(by_id("chart_ms"), { ...options, cost_key: "ms", cost_label: "ms" }),
      chart_fetches: draw_chart(by_id("chart_fetches"), { ...options, cost_key: "fetches", cost_label: "texture fetches per pixel" }),
    };
  };
  by_id("chart_ms_caption").textContent = `${error_label(error)} against time`;
  by_id("chart_fetches_caption").textContent = `${error_label(error)} against texture fetches`;
  draw();
  options.screen_error = await screen_error_of_sites(sites_of_choice(), error);
  if (turn === choice.chart_turn && Number.isFinite(options.screen_error)) draw();
}

function draw_chosen() {
  const pinned = choice.pins.map(row_of_choice).filter(Boolean);
  const site = sites_of_choice()[0] || null;
  const site_rows = choice.camera === "" && site ? rows_of_view(choice.scene, choice.reach, site.camera) : choice.rows;
  draw_charts();
  draw_compare(site, site_rows, pinned, unpin);
}

function describe_choice() {
  const is_setting = row => row.technique !== reference_technique, most = choice.rows.filter(is_setting).length, fronts = find_front(choice.rows, row => row.ms, error_value).length;
  const over = choice.camera === "" ? " over all cameras (means; roots of mean squares; the worst camera for p99, max and memory)" : "";
  const left_out = choice.camera === "" ? unique(rows.filter(row => is_setting(row) && row.scene === choice.scene && row.reach_key === choice.reach).map(row => row.setting)).length - most : 0;
  const missing = left_out ? ` ${left_out} more were not measured with every camera and are left out.` : "";
  return `${most} settings${over}; ${fronts} of them on the front in time. Less is better on both axes.${missing}`;
}

function update() {
  fill_choices();
  mark_fronts(error_value);
  choice.rows = rows_of_view(choice.scene, choice.reach, choice.camera);
  by_id("front_note").textContent = describe_choice();
  draw_chosen();
  draw_table(choice, go);
  const scene = choice.scene;
  draw_extremes(scene, go);
  draw_screen_errors(scene, () => scene === choice.scene);
}

// ---- head and foot ----

function count_words([count, word]) {
  return `${count} ${word}${count === 1 ? "" : "s"}`;
}

function draw_facts() {
  const dates = rows.map(row => row.date).sort();
  const day = date => date.slice(0, 16).replace("T", " ");
  const facts = [["Machine", unique(rows.map(row => row.machine)).join("; ")],
    ["Measured", dates.length ? `${day(dates[0])} to ${day(dates[dates.length - 1])} UTC` : ""], ["Command", report.command],
    ["Build", unique(rows.map(row => row.build)).join(", ")],
    ["Holds", [[rows.length, "row"], [unique(rows.map(row => row.setting)).length, "setting"], [techniques.length, "technique"],
      [unique(rows.map(row => row.scene)).length, "scene"], [report.sites.length, "site"], [picture_elements.size, "picture"]].map(count_words).join(", ")]];
  for (const [name, value] of facts.filter(fact => fact[1])) by_id("facts").append(make_element("div", {}, make_element("dt", {}, name), make_element("dd", {}, value)));
}

function draw_glossary() {
  for (const group of column_groups) {
    const members = columns.filter(column => column.group === group.key);
    const list = members.flatMap(column => [make_element("dt", {}, column.label), make_element("dd", { id: "about_" + column.key }, column.about)]);
    by_id("glossary").append(make_element("div", {}, make_element("dt", { class: "group" }, group.label), make_element("dd", {}, make_element("dl", {}, ...list))));
  }
}

function start() {
  draw_facts();
  draw_glossary();
  if (rows.length === 0) {
    by_id("empty").hidden = false;
    by_id("main").hidden = by_id("choice").hidden = true;
    return;
  }
  choice.pins = unique(rows.filter(row => row.initial && row.technique !== reference_technique).map(row => row.setting)).slice(0, pins_most);
  by_id("techniques").append(...techniques.filter(technique => technique !== reference_technique).map(make_technique_choice));
  for (const id of ["scene", "camera", "reach", "error"]) by_id(id).addEventListener("change", event => {
    choice[id] = event.target.value;
    update();
  });
  for (const id of ["chart_ms", "chart_fetches"]) listen_to_chart(by_id(id), () => charts, pin);
  prepare_compare();
  prepare_table(() => choice, go);
  update();
  window.addEventListener("resize", draw_charts);
}

start();
