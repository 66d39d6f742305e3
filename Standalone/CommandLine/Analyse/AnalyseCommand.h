// SPDX-License-Identifier: GPL-3.0-or-later
// The option `--columns`, shared by commands that read tables of other programs.
#pragma once
#include <string>
#include <vector>

namespace physvib {

class OptionTable;

void declareColumns(OptionTable& command, std::vector<std::string>& words);

} // namespace physvib
