// SPDX-License-Identifier: MIT
// Protocols of studies as JSON, and those that come with PhysVib.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Protocol.h"
#include "Lab/Study/ThesisDeviations.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The version of the format that is written, and the newest that is read.
constexpr int protocolFormatVersion = 1;

/// The valid protocol that `text` describes; or one line `name: sessions[1].repetitions: expected 1 to 1000,
/// found 0`. Any thread.
Result<Protocol> readProtocol(std::string_view text, std::string_view name);

/// The same of a file. M only.
Result<Protocol> loadProtocol(const std::filesystem::path& path);

/// `protocol` as JSON; readProtocol gives it back bit for bit. Any thread.
std::string protocolJson(const Protocol& protocol);

/// 16 hexadecimal digits that change with any field of the protocol. Any thread.
std::string protocolHash(const Protocol& protocol);

/// Those that come with PhysVib, in the order of their listing. Built on first use; any thread.
const std::vector<Protocol>& builtInProtocols();

/// Those, and behind them their versions as published (ThesisVersions.h). Built on first use; any thread.
const std::vector<Protocol>& knownProtocols();

/// Where it does not do what the thesis' study did; none if it is not one of knownProtocols(), or a changed
/// one. Any thread (allocates).
std::vector<ThesisDeviation> deviationsOf(const Protocol& protocol);

/// A file that a protocol names: the one beside the protocol, if it is there, else the one of that path. M
/// only.
std::string besideProtocol(const std::string& folder, const std::string& path);

/// Empty, or that the file which besideProtocol() finds for such a path stands behind a link that leads out
/// of the folder. M only.
std::string linkFault(const std::string& folder, const std::string& path);

/// One of knownProtocols() by its name, else that of the file, which then is the folder of what it names. M
/// only.
Result<Protocol> findProtocol(const std::string& nameOrPath);

} // namespace physvib
