// SPDX-License-Identifier: MIT
#include "reports/comparison/skill_tables.h"

#include "libtrack/nan.h"
#include "reports/comparison/words.h"
#include "reports/write/number.h"
#include "reports/write/unit_text.h"

namespace swarmfit {
namespace {

// One line of fields.
class Line {
 public:
  Line& add(std::string_view text) {
    if (!text_.empty()) text_ += ',';
    text_ += csv_field(text);
    return *this;
  }
  Line& add(double value) {
    text_ += ',' + exact(value);
    return *this;
  }
  Line& add(const Estimate& e) { return add(e.value).add(e.se); }
  std::string end() const { return text_ + '\n'; }

 private:
  std::string text_;
};

std::string skill(const Comparison& c) {
  std::string out = "model,metric,in_skill,total_variation,wasserstein,floor,floor_sd,null,places,informative,skill,skill_se\n";
  const SkillFacts& s = c.recording.skill;
  for (const ModelFit& r : c.models) {
    double mean = 0, number = 0;
    for (std::size_t m = 0; m < c.recording.columns.size(); ++m) {
      if (s.used[m]) mean += r.likeness.total_variation[m], ++number;
      Line line;
      line.add(r.model)
          .add(c.recording.columns[m].key())
          .add(s.used[m] ? "true" : "false")
          .add(r.likeness.total_variation[m])
          .add(r.likeness.wasserstein[m]);
      line.add(s.floor[m]).add(s.floor_sd[m]).add(s.null[m]).add(s.places[m]);
      line.add(s.informative[m] ? "true" : "false").add("").add("");
      out += line.end();
    }
    Line all;
    const bool places = s.null_of == SkillNull::places;
    all.add(r.model).add("all").add("").add(mean / number).add("").add(s.mean_floor).add(s.mean_floor_sd);
    all.add(places ? kNaN : s.mean_null).add(places ? s.mean_null : kNaN).add("").add(r.likeness.skill);
    out += all.end();
  }
  return out;
}

std::string leave_one_out(const Comparison& c) {
  std::string out = "without,rank,model,score,reordered\n";
  for (const LeftOut& w : c.ranking.without) {
    int rank = 0;
    for (const auto& [model, score] : w.ranking)
      out += Line().add(w.model).add(std::to_string(++rank)).add(model).add(score).add(w.reordered ? "true" : "false").end();
  }
  return out;
}

void panel_rows(std::string& out, const Comparison& c, const std::string& of, const std::vector<Estimate>& values) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    const PanelItem& item = c.recording.panel.items[k];
    out += Line().add(of).add(item.key).add(panel_unit(item, c.recording.data.unit)).add(values[k]).end();
  }
}

std::string panel(const Comparison& c) {
  std::string out = "of,observable,unit,value,se\n";
  panel_rows(out, c, "recording", c.recording.panel.recording);
  for (const ModelFit& r : c.models) panel_rows(out, c, r.model, r.likeness.panel);
  return out;
}

std::string vacf(const Comparison& c) {
  Line head;
  head.add("lag_s").add("recording").add("recording_se");
  for (const ModelFit& r : c.models) head.add(r.model).add(r.model + " se");
  std::string out = head.end();
  for (std::size_t k = 0; k < c.recording.panel.lags.size(); ++k) {
    Line line;
    line.add(exact(c.recording.panel.lags[k])).add(c.recording.panel.recording_vacf[k]);
    for (const ModelFit& r : c.models) line.add(r.likeness.vacf[k]);
    out += line.end();
  }
  return out;
}

}  // namespace

std::vector<NamedTable> skill_tables(const Comparison& c) {
  return {{"skill.csv", skill(c)}, {"leave_one_out.csv", leave_one_out(c)}, {"panel.csv", panel(c)}, {"vacf.csv", vacf(c)}};
}

}  // namespace swarmfit
