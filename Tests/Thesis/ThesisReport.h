// SPDX-License-Identifier: MIT
// The thesis again: what it prints beside what can be reckoned from it, and its five studies rehearsed.
#pragma once
#include <map>
#include <string>

namespace physvib {

/// Names within the folder and their bytes: index.html, tables, a folder with a report of its own per
/// rehearsed study. The same bytes every time. M only.
std::map<std::string, std::string> thesisReport();

} // namespace physvib
