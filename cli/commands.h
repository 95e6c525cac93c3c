// SPDX-License-Identifier: MIT
// The commands of the program: each calls the rooms, prints, and returns the exit code. InputError means exit code 2, RunError 1.
#pragma once

#include <string>

#include "cli/arguments.h"

namespace swarmfit::cli {

int run(const Arguments&);  // the command that they name

int describe(const Arguments&);
int convert(const Arguments&);
int evaluate(const Arguments&);
int measure(const Arguments&);
int weigh(const Arguments&);
int simulate(const Arguments&);
int extend(const Arguments&);   // tracks go on, gaps are bridged
int augment(const Arguments&);  // simulated agents among recorded ones
int fit(const Arguments&);      // exactly one model
int compare(const Arguments&);  // two or more
int resume(const Arguments&);
int merge(const Arguments&);  // of the parts of a study, which are resumed as one
// "fit", "compare", "recover", "power" or "sweep": which command left this unfinished run? Throws InputError if there is nothing to go on
// with.
std::string command_of_run(const std::string& dir);
int report(const Arguments&);  // the files of a run in a paper's formats
int recover(const Arguments&);
int power(const Arguments&);
int sweep(const Arguments&);
int gallery(const Arguments&);
int list_models(const Arguments&);
int list_scenarios(const Arguments&);
int list_formats(const Arguments&);
int manual(const Arguments&);      // every command and setting, as a man page or as Markdown
int completion(const Arguments&);  // of a shell

}  // namespace swarmfit::cli
