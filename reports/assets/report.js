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

  // Whiskers of one standard error on bars; Chart.js has none of its own.
  const whiskers = {
    id: "whiskers",
    afterDatasetsDraw(chart) {
      const { ctx, scales: { y } } = chart;
      ctx.save();
      ctx.strokeStyle = css("--text");
      ctx.lineWidth = 1;
      chart.data.datasets.forEach((set, k) => {
        if (!set.errors || !chart.isDatasetVisible(k)) return;
        chart.getDatasetMeta(k).data.forEach((bar, j) => {
          const value = set.data[j], error = set.errors[j];
          if (!isNumber(value) || !isNumber(error)) return;
          const top = y.getPixelForValue(value + error), bottom = y.getPixelForValue(Math.max(0, value - error));
          ctx.beginPath();
          ctx.moveTo(bar.x, top);
          ctx.lineTo(bar.x, bottom);
          ctx.moveTo(bar.x - 2.5, top);
          ctx.lineTo(bar.x + 2.5, top);
          ctx.moveTo(bar.x - 2.5, bottom);
          ctx.lineTo(bar.x + 2.5, bottom);
          ctx.stroke();
        });
      });
      ctx.restore();
    },
  };

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

  // The bins in which somebody has a visible density.
  function visibleBins(metric) {
    const curves = [metric.recording, ...metric.models].filter((curve) => curve.length > 0);
    const peak = Math.max(...metric.recording);
    let first = metric.recording.length, last = -1;
    for (const curve of curves) {
      curve.forEach((q, bin) => {
        if (q < 0.004 * peak) return;
        first = Math.min(first, bin);
        last = Math.max(last, bin);
      });
    }
    return last < first ? [0, metric.recording.length - 1] : [Math.max(0, first - 1), Math.min(metric.recording.length - 1, last + 1)];
  }

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
    const peak = Math.max(...metric.recording);
    return Math.max(...metric.models.flat(), 0) > 2 * peak && peak > 0 ? 2 * peak : undefined;
  }

  function density(metric) {
    const logarithmic = document.getElementById("log").checked;
    const bins = visibleBins(metric);
    const recording = {
      label: "recording", data: points(metric, metric.recording, bins, logarithmic), borderColor: css("--recording"), borderWidth: 1.25,
      backgroundColor: css("--recording-fill"), fill: "start", pointRadius: 0, order: 100,
    };
    const models = metric.models.map((curve, k) => ({ ...modelLine(k, points(metric, curve, bins, logarithmic)), order: k }));
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
            type: "linear", min: metric.lower + bins[0] * metric.width, max: metric.lower + (bins[1] + 1) * metric.width, ticks: tick }),
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

  const metricLabel = (metric) => (metric.counts ? metric.symbol : `(${metric.symbol})`);

  function energies() {
    return {
      type: "bar",
      data: {
        labels: data.metrics.map(metricLabel),
        datasets: data.models.map((model, k) => ({
          label: model.name, data: model.energies, errors: model.errors, backgroundColor: seriesColour(k), categoryPercentage: 0.8, barPercentage: 0.92,
        })),
      },
      options: { scales: { x: axis("metric (in brackets: left out of the score)", { grid: { display: false } }), y: axis("raw energy", { min: 0, ticks: tick }) } },
      plugins: [whiskers],
    };
  }

  function weights() {
    return {
      type: "bar",
      data: { labels: data.metrics.map(metricLabel), datasets: [{ label: "weight", data: data.weights, backgroundColor: css("--accent"), barPercentage: 0.7 }] },
      options: { scales: { x: axis("metric", { grid: { display: false } }), y: axis("weight", { min: 0, ticks: tick }) } },
    };
  }

  function history() {
    const used = data.metrics.map((metric, m) => ({ metric, m })).filter(({ metric }) => metric.counts);
    return {
      type: "line",
      data: {
        labels: data.history.map((step) => step.pass),
        datasets: used.map(({ metric, m }, k) => ({
          label: metric.symbol, data: data.history.map((step) => step.weights[m]), borderColor: seriesColour(k), backgroundColor: seriesColour(k),
          borderDash: dashes[k % dashes.length], borderWidth: 1.75, pointRadius: 3,
        })),
      },
      options: {
        scales: { x: axis("pass of the calibration"), y: axis("weight", { min: 0, ticks: tick }) },
        plugins: { legend: { display: true, position: "right", labels: { color: css("--soft"), boxWidth: 24, boxHeight: 0 } } },
      },
    };
  }

  // Points of one model with a hole between passes: scores of different weights are not to be joined.
  function curve(model) {
    const out = [];
    model.convergence.forEach(([pass, evaluations, best], k) => {
      if (k > 0 && model.convergence[k - 1][0] !== pass) out.push({ x: evaluations, y: NaN });
      out.push({ x: evaluations, y: isNumber(best) ? best : NaN });
    });
    return out;
  }

  function convergence() {
    return {
      type: "line",
      data: { datasets: data.models.map((model, k) => ({ ...modelLine(k, curve(model)), stepped: true, pointRadius: model.convergence.length < 2 ? 3 : 0 })) },
      options: {
        parsing: false,
        scales: { x: axis("candidates simulated", { type: "linear", ticks: tick }), y: axis("best score so far", { ticks: tick }) },
      },
    };
  }

  function drawAll() {
    data.metrics.forEach((metric) => { if (metric.recording.length > 0) draw(`pdf-${metric.key}`, () => density(metric), 1); });
    draw("energy-chart", energies, 0);
    draw("weight-chart", weights);
    draw("history-chart", history);
    draw("convergence-chart", convergence, 0);
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
