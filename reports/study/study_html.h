// SPDX-License-Identifier: MIT
// The page of a study (recover, power): the answer in words, what it rests on, and how to repeat it. As safe as report_html; the only
// script is the one that sorts tables.
#pragma once

#include <string>
#include <vector>

#include "reports/write/html_table.h"
#include "reports/write/run_folder.h"

namespace swarmfit {

struct StudySection {
  std::string id, title;  // our own words
  Html content;
};

struct StudyPage {
  std::string command;           // "recover"
  std::string kind;              // what stands over the answer
  std::string sentence, detail;  // the answer, and what to know before quoting it
  Html badge, facts, warnings;
  std::vector<StudySection> sections;
  Html files;  // where the numbers are in full
  Settings settings;
  std::string version;
};

std::string study_html(const StudyPage&);

// A setting as it was given, without the quotes of TOML; empty if there is none of this name.
std::string setting(const Settings&, std::string_view name);

}  // namespace swarmfit
