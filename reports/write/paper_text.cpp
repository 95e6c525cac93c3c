// SPDX-License-Identifier: MIT
#include "reports/write/paper_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;

constexpr std::array kCommands{Pair{"\\", "\\textbackslash{}"},
                               Pair{"&", "\\&"},
                               Pair{"%", "\\%"},
                               Pair{"$", "\\$"},
                               Pair{"#", "\\#"},
                               Pair{"_", "\\_"},
                               Pair{"{", "\\{"},
                               Pair{"}", "\\}"},
                               Pair{"~", "\\textasciitilde{}"},
                               Pair{"^", "\\^{}"},
                               Pair{"±", "$\\pm$"},
                               Pair{"–", "--"},
                               Pair{"—", "---"},
                               Pair{"−", "$-$"},
                               Pair{"·", "$\\cdot$"},
                               Pair{"×", "$\\times$"},
                               Pair{"√", "$\\sqrt{\\;}$"},
                               Pair{"≤", "$\\leq$"},
                               Pair{"≥", "$\\geq$"},
                               Pair{"Σ", "$\\Sigma$"},
                               Pair{"°", "$^\\circ$"},
                               Pair{"µ", "$\\mu$"},
                               Pair{"…", "\\ldots{}"},
                               Pair{"\u202f", "\\,"},
                               Pair{"\u00a0", "~"},
                               Pair{"<", "$<$"},
                               Pair{">", "$>$"},
                               Pair{"|", "$|$"},
                               Pair{"α", "$\\alpha$"},
                               Pair{"β", "$\\beta$"},
                               Pair{"γ", "$\\gamma$"},
                               Pair{"δ", "$\\delta$"},
                               Pair{"ε", "$\\varepsilon$"},
                               Pair{"ζ", "$\\zeta$"},
                               Pair{"η", "$\\eta$"},
                               Pair{"θ", "$\\theta$"},
                               Pair{"κ", "$\\kappa$"},
                               Pair{"λ", "$\\lambda$"},
                               Pair{"μ", "$\\mu$"},
                               Pair{"ν", "$\\nu$"},
                               Pair{"ξ", "$\\xi$"},
                               Pair{"π", "$\\pi$"},
                               Pair{"ρ", "$\\rho$"},
                               Pair{"σ", "$\\sigma$"},
                               Pair{"τ", "$\\tau$"},
                               Pair{"φ", "$\\varphi$"},
                               Pair{"χ", "$\\chi$"},
                               Pair{"ψ", "$\\psi$"},
                               Pair{"ω", "$\\omega$"},
                               Pair{"Δ", "$\\Delta$"},
                               Pair{"Ω", "$\\Omega$"},
                               Pair{"\"", "''"}};

constexpr std::array kRaised{Pair{"⁻", "-"}, Pair{"⁰", "0"}, Pair{"¹", "1"}, Pair{"²", "2"}, Pair{"³", "3"}, Pair{"⁴", "4"},
                             Pair{"⁵", "5"}, Pair{"⁶", "6"}, Pair{"⁷", "7"}, Pair{"⁸", "8"}, Pair{"⁹", "9"}};

constexpr std::string_view kPoint = "·";  // between raised digits

template <std::size_t N>
const Pair* find(const std::array<Pair, N>& table, std::string_view text) {
  const auto* found = std::find_if(table.begin(), table.end(), [&](const Pair& p) { return text.starts_with(p.first); });
  return found == table.end() ? nullptr : found;
}

bool word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Bytes of a Greek symbol with a subscript, "τ_v", that begins here; 0: there is none. Latin ones look like names, and stay text.
std::size_t subscripted(std::string_view before, std::string_view text) {
  const Pair* greek = find(kCommands, text);
  const std::size_t base = greek != nullptr && greek->first.size() == 2 && greek->second.starts_with("$\\") ? 2 : 0;
  if (base == 0 || text.size() < base + 2 || text[base] != '_' || (!before.empty() && (word(before.back()) || before.back() == '_')))
    return 0;
  std::size_t end = base + 1;
  while (end < text.size() && word(text[end])) ++end;
  return end == base + 1 || (end < text.size() && text[end] == '_') ? 0 : end;
}

// "$\tau_{v}$", "$\chi_{\mathrm{rep}}$"
std::string math_of(std::string_view symbol) {
  const std::size_t at = symbol.find('_');
  std::string base(symbol.substr(0, at));
  if (const Pair* greek = find(kCommands, base); greek != nullptr) base = std::string(greek->second.substr(1, greek->second.size() - 2));
  const std::string below(symbol.substr(at + 1));
  return fmt::format("${}_{{{}}}$", base, below.size() > 1 ? fmt::format("\\mathrm{{{}}}", below) : below);
}

}  // namespace

std::string latex_text(std::string_view utf8) {
  const std::string text = printable(utf8);
  std::string out;
  for (std::string_view rest = text; !rest.empty();) {
    std::string raised;
    for (const Pair* p = nullptr; (p = find(kRaised, rest)) != nullptr; rest.remove_prefix(p->first.size())) {
      raised += p->second;
      if (rest.substr(p->first.size()).starts_with(kPoint) && find(kRaised, rest.substr(p->first.size() + kPoint.size())) != nullptr) {
        raised += '.';
        rest.remove_prefix(kPoint.size());
      }
    }
    if (!raised.empty()) {
      out += "$^{" + raised + "}$";
      continue;
    }
    if (const std::size_t length = subscripted(out, rest); length > 0) {
      out += math_of(rest.substr(0, length));
      rest.remove_prefix(length);
      continue;
    }
    const Pair* command = find(kCommands, rest);
    out += command ? command->second : rest.substr(0, 1);
    rest.remove_prefix(command ? command->first.size() : 1);
  }
  return out;
}

std::string markdown_text(std::string_view utf8) {
  constexpr std::string_view kMarkup = "|\\`*_<[]";
  std::string out;
  for (const char c : printable(utf8)) {
    if (kMarkup.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

}  // namespace swarmfit
