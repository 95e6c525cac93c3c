// SPDX-License-Identifier: MIT
// The commands of the program: each calls the rooms, prints, and returns the exit code. InputError means exit code 2, RunError 1.
#pragma once

#include <string>

#include "cli/arguments.h"

namespace swarmfit::cli {

int describe(const DescribeArguments&);
int convert(const ConvertArguments&);
int evaluate(const EvaluateArguments&);
int weigh(const WeighArguments&);
int simulate(const SimulateArguments&);
int fit(const FitArguments&);      // exactly one model
int compare(const FitArguments&);  // two or more
// "fit", "compare", "recover" or "power": which command left this unfinished run? Throws InputError if there is nothing to go on with.
std::string command_of_run(const std::string& dir);
int report(const ReportArguments&);  // the files of a run in a paper's formats
int recover(const RecoverArguments&);
int power(const PowerArguments&);
int gallery(const GalleryArguments&);
int list_models(const ModelsArguments&);
int list_formats(const Common&);

}  // namespace swarmfit::cli
