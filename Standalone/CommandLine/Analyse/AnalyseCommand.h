// SPDX-License-Identifier: GPL-3.0-or-later
// `--columns`, for those who read other programs' tables.
#pragma once
#include <string>
#include <vector>

namespace physvib {

class OptionTable;

void declareColumns(OptionTable& command, std::vector<std::string>& words);

} // namespace physvib
