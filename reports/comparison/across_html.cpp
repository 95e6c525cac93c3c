// SPDX-License-Identifier: MIT
#include "reports/comparison/across_html.h"

#include <fmt/format.h>

#include <cmath>

#include "reports/comparison/across_report.h"
#include "reports/comparison/html_paper_table.h"
#include "reports/comparison/words.h"
#include "reports/write/assets.h"
#include "reports/write/number.h"
#include "reports/write/page.h"
#include "reports/write/plain_text.h"

namespace swarmfit {
namespace {

// A file name as part of a link: everything but letters, digits and -._~/ becomes %XX (RFC 3986, section 2.3).
std::string percent_encoded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

Html link(const RecordingPage& page, std::string_view text) {
  return {fmt::format("<a href=\"./{}/report.html\">{}</a>", percent_encoded(page.folder), html_escaped(printable(text)))};
}

Html recordings(const Across& a, const std::vector<RecordingPage>& pages) {
  HtmlTable t("Result of each recording.");
  t.head({column("recording"), column("answer")});
  for (std::size_t k = 0; k < a.recordings.size(); ++k) t.row({name_cell(link(pages[k], a.recordings[k])), text_cell(pages[k].sentence)});
  return t.html();
}

// Over whom does the lead of the first hold, if the recordings are a sample of more of their kind?
std::string beyond_these(const Across& a) {
  std::vector<std::string> holds, open;
  for (const ModelAcross& m : a.models)
    if (std::isfinite(m.lead.lower)) (m.lead.lower > 0 ? holds : open).push_back(m.model);
  if (holds.empty() && open.empty()) return "";
  const std::string all = fmt::format(" If these recordings are a random sample of their kind, the lead of {} ", a.models.front().model);
  if (holds.empty()) return all + "holds over no other model (95 %).";
  if (open.empty()) return all + "holds over every other model (95 %).";
  return all + fmt::format("holds over {}, but not over {} (95 %).", enumerate(holds), enumerate(open));
}

}  // namespace

std::string across_sentence(const Across& a) {
  if (a.models.empty() || !std::isfinite(a.models.front().mean_rank)) return "No model could be scored on any recording";
  const ModelAcross& best = a.models.front();
  if (best.wins == static_cast<int>(a.recordings.size())) return fmt::format("{} is first on all {} recordings", best.model, best.wins);
  std::vector<std::string> level;
  for (const ModelAcross& m : a.models)
    if (m.mean_rank == best.mean_rank) level.push_back(m.model);
  if (level.size() > 1) return fmt::format("{} share the best mean rank, {}", enumerate(level), fixed(best.mean_rank, 2));
  return fmt::format("{} has the best mean rank, {}; it is first on {} of {} recordings", best.model, fixed(best.mean_rank, 2), best.wins,
                     a.recordings.size());
}

std::string across_detail(const Across& a) {
  std::vector<std::string> others;
  for (const ModelAcross& m : a.models)
    if (&m != &a.models.front() && m.wins > 0) others.push_back(fmt::format("{} on {}", m.model, m.wins));
  const std::string also = others.empty() ? "" : fmt::format("Also first: {}. ", enumerate(others));
  return also + "First places include ties; the reports of the recordings say which." + beyond_these(a);
}

std::string across_html(const Across& a, const std::vector<RecordingPage>& pages, const std::string& version) {
  std::string ranking, weights;
  for (const PaperTable& t : paper_tables(a))
    (t.name == "across_ranking" ? ranking : weights) += on_screen(t, t.name == "across_ranking").html().text;
  return filled(assets::across_html, {{"policy", content_policy(assets::report_css, {assets::sort_js})},
                                      {"css", std::string(assets::report_css)},
                                      {"sort_js", std::string(assets::sort_js)},
                                      {"count", std::to_string(a.recordings.size())},
                                      {"sentence", html_escaped(across_sentence(a))},
                                      {"detail", html_escaped(across_detail(a))},
                                      {"ranking", ranking},
                                      {"recordings", recordings(a, pages).text},
                                      {"weights", weights},
                                      {"version", html_escaped(version)}});
}

}  // namespace swarmfit
