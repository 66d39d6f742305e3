// SPDX-License-Identifier: GPL-3.0-or-later
// Which words of a call name files that it writes; all others may name files that it reads. And what of it a
// call in somebody's file may do.
#pragma once
#include "Options/OptionTable.h"
#include <string>
#include <string_view>

namespace physvib {

/// Empty, or that what was parsed names a file to be written that it reads, or one file to be written twice.
/// M.
std::string clashOfCall(const OptionTable& app);

/// Empty, or that a call "render ..." or "stimulus ..." of a file names a file to be written: it has an
/// option that the table knows as one (Option::written), wherever it stands. M.
std::string writtenWordFault(std::string_view call);

/// Empty, or that what was parsed of a file's call reads a file through a link that leads out of its folder
/// (see linkFault). M.
std::string linkOfCallFault(const OptionTable& app, const std::string& folder);

} // namespace physvib
