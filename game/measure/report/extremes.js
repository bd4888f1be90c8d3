// The worst of each technique, and how far exact rays come that see only the depth buffer.

const extreme_keys = ["p99", "max", "bias", "noise", "flicker", "instability", "instability_relative"];

function badness(column, row) {
  const value = row[column.key];
  return Number.isFinite(value) ? Math.abs(value) : -1;
}

function find_worst(column, candidates) {
  return candidates.reduce((worst, row) => (badness(column, row) > (worst ? badness(column, worst) : -1) ? row : worst), null);
}

function draw_extremes(scene, go) {
  const of_scene = rows.filter(row => row.scene === scene && row.technique !== reference_technique);
  const shown = extreme_keys.map(key => column_of.get(key));
  const worst_of_all = shown.map(column => find_worst(column, of_scene));
  const body = unique(of_scene.map(row => row.technique)).map(technique => {
    const own = of_scene.filter(row => row.technique === technique);
    const cells = shown.map((column, index) => {
      const row = find_worst(column, own);
      if (!row) return make_element("td", {}, "-");
      const button = make_element("button", { type: "button", class: "plain", title: `${row.setting}\n${row.camera}, ${row.reach}`, onclick: () => go(row) }, print_value(column, row));
      return make_element("td", { class: row === worst_of_all[index] ? "worst" : "" }, button);
    });
    return make_element("tr", {}, make_element("th", { scope: "row" }, make_sign_icon(technique), technique), ...cells);
  });
  by_id("extremes").replaceChildren(make_element("thead", {}, make_element("tr", {}, make_element("th", { scope: "col", class: "text" }, "technique"),
    ...shown.map(column => make_element("th", { scope: "col", title: column.about }, column.key === "instability_relative" ? "relative instability" : column.of_label || column.label)))),
    make_element("tbody", {}, ...body));
}

// ---- exact rays through what the depth buffer shows ----

// As measured when the reference itself was restricted to the depth buffer, else from the two truths' pictures (8 bits a pixel).
async function measure_screen(site) {
  const measured = rows.find(row => row.technique === reference_technique && row.setting.includes("sees=screen") && site_of_row(row) === site);
  if (measured) return { rmse: measured.rmse, bias: measured.bias, mae: measured.mae, p99: measured.p99, max: measured.max };
  if (!has_picture(site.truth) || !has_picture(site.screen)) return null;
  const [screen, truth, mask] = await Promise.all([read_picture(site.screen), read_picture(site.truth), read_site_picture(site, "geometry")]);
  return measure_errors(screen, truth, mask);
}

const screen_errors = new Map(); // by site: found once

async function screen_error_of(site) {
  if (!screen_errors.has(site)) screen_errors.set(site, await measure_screen(site));
  return screen_errors.get(site);
}

// Of several cameras together; NaN where the error has none or there are no pictures.
async function screen_error_of_sites(sites, column) {
  const found = [];
  for (const site of sites) found.push(await screen_error_of(site));
  const number = report.columns.find(candidate => candidate.key === column.key);
  const value = number ? over_cameras(number.over, found.map(screen_error => (screen_error && column.key in screen_error ? screen_error[column.key] : NaN))) : NaN;
  return column.of ? column.of(value) : value;
}

async function draw_screen_errors(scene, is_current) {
  const sites = report.sites.filter(site => site.scene === scene), keys = ["rmse", "bias", "mae", "p99", "max"];
  const lines = [];
  for (const site of sites) {
    const screen_error = await screen_error_of(site);
    if (!is_current()) return;
    lines.push(make_element("tr", {}, make_element("th", { scope: "row" }, site.camera), make_element("td", { class: "text" }, describe_site(site)),
      ...keys.map(key => make_element("td", {}, screen_error ? column_of.get(key).format(screen_error[key]) : "-")),
      make_element("td", {}, three_digits(site.reference_noise ?? NaN)), make_element("td", {}, String(site.reference_rays))));
  }
  by_id("screen_errors").replaceChildren(make_element("thead", {}, make_element("tr", {}, make_element("th", { scope: "col", class: "text" }, "camera"), make_element("th", { scope: "col", class: "text" }, "reach"),
    ...keys.map(key => make_element("th", { scope: "col", title: column_of.get(key).about }, column_of.get(key).label)),
    make_element("th", { scope: "col", title: column_of.get("reference_noise").about }, "truth's noise"), make_element("th", { scope: "col", title: column_of.get("reference_rays").about }, "rays"))),
    make_element("tbody", {}, ...lines));
}

// A site knows no part of the diagonal; its rows do.
function describe_site(site) {
  return describe_reach(rows.find(row => site_of_row(row) === site) || { ...site, r_max_part: 0 });
}
