// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the output files and input files in a call, and checks calls that come from untrusted files.
#pragma once
#include "Options/OptionTable.h"
#include <string>
#include <string_view>

namespace physvib {

/// Empty, or an error if the parsed call would write a file that it reads, or one file twice. Message thread.
std::string clashOfCall(const OptionTable& app);

/// Empty, or an error if a call "render ..." or "stimulus ..." in a file names an output file, i.e. has an
/// option marked Option::written anywhere. Message thread.
std::string writtenWordFault(std::string_view call);

/// Empty, or an error if the parsed call of a file reads through a link that leads out of the file's folder
/// (see linkFault). Message thread.
std::string linkOfCallFault(const OptionTable& app, const std::string& folder);

} // namespace physvib
