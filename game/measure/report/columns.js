// What each number is: its name, how it is printed, and its definition. The keys are those of game/measure/sample_columns.c.

const column_groups = [
  { key: "what", label: "Setting", always: true },
  { key: "place", label: "Where", always: true },
  { key: "cost", label: "Cost" },
  { key: "truth", label: "Error against the truth" },
  { key: "screen", label: "Error against the depth buffer's geometry" },
  { key: "edges", label: "RMSE near silhouettes" },
  { key: "steady", label: "Steadiness" },
  { key: "reference", label: "Truth" },
];

const fixed = digits => value => value.toFixed(digits);
const signed = digits => value => (value < 0 ? "-" : "+") + Math.abs(value).toFixed(digits);
const three_digits = value => (Math.abs(value) >= 100 ? value.toFixed(0) : Number(value.toPrecision(3)).toString());
const mebibytes = value => (value / 1048576).toFixed(2);
const seconds = value => (value / 1000).toFixed(2);

// of: how bad a value is, where the sign or the direction must go; text: sorted and shown as it is.
const columns = [
  { key: "setting", group: "what", label: "setting", text: true,
    about: "Technique and every parameter that is not at its initial value. A technique alone is as it comes." },
  { key: "front", group: "what", label: "front", text: true,
    about: "Whether the row stands on the front of its scene, camera and reach: no other setting is at most as dear and at most as wrong in the chosen error. By medians: of two whose times overlap from min to max either may be the faster. Dear in ms, in fetches, or in both." },
  { key: "scene", group: "place", label: "scene", text: true, about: "The file's name. Columns of this group stand only where the rows differ in them." },
  { key: "camera", group: "place", label: "camera", text: true, about: "The camera's name." },
  { key: "short_reach", group: "place", label: "reach", text: true,
    about: "r_max: how far occlusion reaches, in metres and as a part of the scene's diagonal; where they differ also how it falls off with distance, and the picture's size." },
  { key: "ms", group: "cost", label: "ms", format: three_digits,
    about: "Time of one whole pass (prepare, trace, filter, upscale), milliseconds on the wall clock around glFinish: median of five turns (three of slow settings) that all settings take." },
  { key: "ms_min", group: "cost", label: "min", format: three_digits, about: "The fastest of the turns that the setting was timed in, ms." },
  { key: "ms_max", group: "cost", label: "max", format: three_digits, about: "The slowest of the turns, ms." },
  { key: "gpu_ms", group: "cost", label: "GPU ms", format: three_digits,
    about: "Median of the GPU's own timer, ms; none on software GL, where such timers lie." },
  { key: "fetches", group: "cost", label: "fetches", format: three_digits,
    about: "All texture fetches of a whole pass, from preparing to filter and upscaling, over the pixels with geometry; counted by the shaders." },
  { key: "volume_bytes", group: "cost", label: "volumes MiB", format: mebibytes,
    about: "Memory of the volumes on the GPU; 0 for techniques that read none." },
  { key: "texture_bytes", group: "cost", label: "textures MiB", format: mebibytes,
    about: "Memory of the pass's own textures at this size and scale." },
  { key: "bake_ms", group: "cost", label: "bake s", format: seconds,
    about: "Baking all volumes of the scene without any cache, seconds; 0 for techniques that read none." },
  { key: "rmse", group: "truth", label: "RMSE", format: fixed(4), of: value => value,
    about: "Root of the mean squared difference of visibility from the truth, over pixels with geometry." },
  { key: "bias", group: "truth", label: "bias", format: signed(4), of: Math.abs, of_label: "|bias|",
    about: "Mean of visibility minus truth: + is too bright (occlusion missed), - too dark." },
  { key: "mae", group: "truth", label: "MAE", format: fixed(4), of: value => value, about: "Mean absolute difference from the truth." },
  { key: "p99", group: "truth", label: "p99", format: fixed(3), of: value => value, about: "99 of 100 pixels differ by at most this." },
  { key: "max", group: "truth", label: "max", format: fixed(3), of: value => value, about: "The largest difference of any pixel." },
  { key: "ssim", group: "truth", label: "SSIM", format: fixed(4), of: value => 1 - value, of_label: "1 - SSIM",
    about: "Mean structural similarity with the truth: 1 is equal." },
  { key: "ssim_ceiling", group: "truth", label: "SSIM ceiling", format: fixed(4),
    about: "About the SSIM that a picture without any error would have: the truth's own noise lowers it." },
  { key: "screen_rmse", group: "screen", label: "RMSE", format: fixed(4), of: value => value, of_label: "RMSE, depth buffer",
    about: "RMSE against rays through only what the depth buffer shows: the estimator's own error, without geometry that the screen does not hold." },
  { key: "screen_bias", group: "screen", label: "bias", format: signed(4), of: Math.abs, of_label: "|bias|, depth buffer",
    about: "Mean difference from the same." },
  { key: "screen_mae", group: "screen", label: "MAE", format: fixed(4), about: "Mean absolute difference from the same." },
  { key: "screen_p99", group: "screen", label: "p99", format: fixed(3), about: "99 of 100 pixels differ from the same by at most this." },
  { key: "screen_max", group: "screen", label: "max", format: fixed(3), about: "The largest difference from the same." },
  { key: "inside", group: "edges", label: "inside", format: fixed(4), of: value => value, of_label: "RMSE inside silhouettes",
    about: "RMSE on the near side of silhouettes, within a few pixels of them." },
  { key: "outside", group: "edges", label: "outside", format: fixed(4), of: value => value, of_label: "RMSE outside silhouettes",
    about: "RMSE on the far side of silhouettes, where halos are." },
  { key: "away", group: "edges", label: "away", format: fixed(4), of: value => value, of_label: "RMSE away from silhouettes",
    about: "RMSE everywhere else." },
  { key: "noise", group: "steady", label: "noise", format: fixed(4), of: value => value, of_label: "noise",
    about: "Standard deviation between seeds at each pixel, RMS over the pixels." },
  { key: "flicker", group: "steady", label: "flicker", format: fixed(4), of: value => value, of_label: "flicker",
    about: "RMS change at the same points of the scene between consecutive frames of a short camera path. Its floor is not 0: points are read between pixels, and the truth changes at edges too." },
  { key: "instability", group: "steady", label: "instability", format: fixed(4), of: value => value, of_label: "instability",
    about: "RMS difference at the same points of the scene between this camera and a second one. Its floor is not 0: see flicker; ./nook compare gives that of the reference." },
  { key: "instability_relative", group: "steady", label: "relative", format: fixed(3),
    about: "Instability over what two unrelated pictures of the same contrast would give: 0 is tied to the surfaces, 1 has nothing to do with them." },
  { key: "reference_noise", group: "reference", label: "noise", format: three_digits,
    about: "RMS of the truth's own noise; it stands in quadrature in the RMSE." },
  { key: "reference_rays", group: "reference", label: "rays", format: fixed(0), about: "Rays for each pixel of the truth." },
];

const column_of = new Map(columns.map(column => [column.key, column]));
const error_columns = columns.filter(column => column.of);

function error_label(column) {
  return column.of_label || column.label;
}

// A cell's text: a dash where there is no number.
function print_value(column, row) {
  const value = row[column.key];
  if (column.text) return value;
  return Number.isFinite(value) ? column.format(value) : "-";
}
