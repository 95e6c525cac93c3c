// SPDX-License-Identifier: MIT
// Draws the charts of a report from the JSON in the page. The tables beside them hold the same numbers, so nothing is lost without this.
"use strict";

(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const dashes = [[], [7, 3], [2, 2], [9, 3, 2, 3], [4, 2], [12, 4], [1, 3], [6, 2, 1, 2, 1, 2]];
  const colours = 8;
  const charts = [];
  const modelCharts = [];  // those with one dataset per model: {chart, first}, `first` being the dataset of model 0

  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const seriesColour = (k) => css(`--series-${k % colours}`);
  const isNumber = (x) => typeof x === "number";

  // Four significant digits without noise, with thin spaces between thousands.
  function text(x) {
    if (!isNumber(x)) return "–";
    const size = Math.abs(x);
    if (size !== 0 && (size < 1e-4 || size >= 1e7)) return x.toExponential(2).replace(/\.?0+e/, "e");
    return Number(x.toPrecision(4)).toLocaleString("en-GB", { maximumSignificantDigits: 4 }).replaceAll(",", "\u202f");
  }

  function axis(title, more = {}) {
    return {
      title: { display: true, text: title, color: css("--soft") },
      grid: { color: css("--grid"), borderColor: css("--line") },
      ticks: { color: css("--soft"), maxTicksLimit: 7, includeBounds: false, ...more.ticks },
      ...Object.fromEntries(Object.entries(more).filter(([key]) => key !== "ticks")),
    };
  }

  const tick = { callback: (value) => text(value) };

  function draw(id, build, first = null) {
    const canvas = document.getElementById(id);
    if (!canvas) return;
    const configuration = build();
    configuration.options = {
      animation: false, responsive: true, maintainAspectRatio: false, normalized: true,
      interaction: { mode: "nearest", axis: "x", intersect: false },
      ...configuration.options,
    };
    configuration.options.plugins = {
      legend: { display: false },
      tooltip: { callbacks: { label: (item) => `${item.dataset.label}: ${text(item.parsed.y)}` } },
      ...configuration.options.plugins,
    };
    const chart = new Chart(canvas, configuration);
    charts.push({ chart, build });
    if (first !== null) modelCharts.push({ chart, first });
  }

  function modelLine(k, points) {
    return {
      label: data.models[k].name, data: points, borderColor: seriesColour(k), borderDash: dashes[k % dashes.length],
      borderWidth: k === 0 ? 2.5 : 1.75, pointRadius: 0, pointHitRadius: 6, tension: 0,
    };
  }

  // The end bins hold all that lies beyond them: drawn, they would be peaks that nothing has.
  const innerBins = (metric) => {
    const bins = metric.recording.length;
    return data.clip && bins > 2 ? [1, bins - 2] : [0, bins - 1];
  };

  // The bins with a visible density in the recording or a model.
  function visibleBins(metric) {
    const curves = [metric.recording, ...metric.models].filter((curve) => curve.length > 0), [from, to] = innerBins(metric);
    const peak = Math.max(...metric.recording.slice(from, to + 1));
    let first = to, last = from;
    for (const curve of curves) {
      for (let bin = from; bin <= to; ++bin) {
        if (!(curve[bin] >= 0.004 * peak)) continue;
        first = Math.min(first, bin);
        last = Math.max(last, bin);
      }
    }
    if (last < first) return [from, to];
    // Nothing but angular acceleration can be negative.
    const least = metric.signed ? from : Math.max(from, Math.ceil(-metric.lower / metric.width - 0.5));
    return [Math.max(Math.min(least, first), first - 1), Math.min(to, last + 1)];
  }

  // A value that hardly varies fills one or two bins: bars say so, and a line would make triangles of them.
  const narrow = (curve) => curve.filter((q) => q > 0).length <= 3;

  function points(metric, curve, [first, last], logarithmic) {
    const out = [];
    for (let bin = first; bin <= last && bin < curve.length; ++bin) {
      const q = curve[bin];
      out.push({ x: metric.lower + (bin + 0.5) * metric.width, y: logarithmic && q === 0 ? null : q });
    }
    return out;
  }

  // Narrow peaks would flatten all others: they are cut at twice the recording's.
  function highest(metric) {
    const [from, to] = innerBins(metric), peak = Math.max(...metric.recording.slice(from, to + 1));
    return Math.max(...metric.models.map((curve) => curve.slice(from, to + 1)).flat(), 0) > 2 * peak && peak > 0 ? 2 * peak : undefined;
  }

  function density(metric) {
    const logarithmic = document.getElementById("log").checked;
    const bins = visibleBins(metric);
    const recording = {
      label: "recording", data: points(metric, metric.recording, bins, logarithmic), borderColor: css("--recording"), borderWidth: 1.25,
      backgroundColor: css("--recording-fill"), fill: "start", pointRadius: 0, order: 100, stepped: narrow(metric.recording) ? "middle" : false,
    };
    const models = metric.models.map((curve, k) => ({ ...modelLine(k, points(metric, curve, bins, logarithmic)), order: k, stepped: narrow(curve) ? "middle" : false }));
    // Where recordings made by the first model lie; after the models, whose places the legend counts.
    const edge = { label: "band", borderWidth: 0, pointRadius: 0, pointHitRadius: 0, order: 50 };
    const band = metric.band[0].length === 0 ? [] : [
      { ...edge, data: points(metric, metric.band[0], bins, logarithmic) },
      { ...edge, data: points(metric, metric.band[1], bins, logarithmic), fill: "-1", backgroundColor: css("--band") },
    ];
    return {
      type: "line",
      data: { datasets: [recording, ...models, ...band] },
      options: {
        parsing: false,
        scales: {
          x: axis(`${metric.name} ${metric.symbol} [${metric.unit}]`, {
            type: "linear", min: metric.signed ? metric.lower + bins[0] * metric.width : Math.max(0, metric.lower + bins[0] * metric.width), max: metric.lower + (bins[1] + 1) * metric.width, ticks: tick }),
          y: axis(`density [${metric.density_unit}]`, { type: logarithmic ? "logarithmic" : "linear", ...(logarithmic ? {} : { min: 0, max: highest(metric) }), ticks: tick }),
        },
        plugins: {
          tooltip: {
            filter: (item) => item.dataset.label !== "band",
            callbacks: {
              title: (items) => (items.length > 0 ? `${metric.symbol} = ${text(items[0].parsed.x)} ${metric.unit}` : ""),
              label: (item) => `${item.dataset.label}: ${text(item.parsed.y)}`,
            },
          },
        },
      },
    };
  }

  function drawAll() {
    data.metrics.forEach((metric) => { if (metric.recording.length > 0) draw(`pdf-${metric.key}`, () => density(metric), 1); });
  }

  function showChosenModels() {
    document.querySelectorAll("#legend input[data-model]").forEach((box) => {
      modelCharts.forEach(({ chart, first }) => chart.setDatasetVisibility(first + Number(box.dataset.model), box.checked));
    });
    modelCharts.forEach(({ chart }) => chart.update());
  }

  // Colours live in the style sheet, so a change of scheme or medium means drawing anew.
  function redraw() {
    charts.forEach(({ chart }) => chart.destroy());
    charts.length = modelCharts.length = 0;
    drawAll();
    showChosenModels();
  }

  Chart.defaults.font.family = css("font-family") || getComputedStyle(document.body).fontFamily;
  Chart.defaults.font.size = 12;
  drawAll();
  document.getElementById("legend").addEventListener("change", (event) => (event.target.id === "log" ? redraw() : showChosenModels()));
  document.getElementById("legend").addEventListener("submit", (event) => event.preventDefault());
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((part) => { part.open = true; }));
  for (const query of ["(prefers-color-scheme: dark)", "print"]) matchMedia(query).addEventListener("change", redraw);
})();
