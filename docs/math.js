// SPDX-License-Identifier: MIT
// Sets the equations of a page, which stand between \( and \), or \[ and \].
document.addEventListener("DOMContentLoaded", () => {
  for (const part of document.querySelectorAll(".arithmatex")) {
    const text = part.textContent.trim();
    katex.render(text.slice(2, -2), part, { displayMode: text.startsWith("\\["), throwOnError: false });
  }
});
