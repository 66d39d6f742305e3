// SPDX-License-Identifier: MIT
// Study protocols as JSON files, and the built-in protocols.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Protocol.h"
#include "Lab/Study/ThesisDeviations.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Version of the format that is written, and the newest that can be read.
constexpr int protocolFormatVersion = 1;
constexpr const char* protocolVersionField = "physvib_protocol";

/// Parses a valid protocol; otherwise one line `name: sessions[1].repetitions: expected 1 to 1000, found 0`.
/// Any thread.
Result<Protocol> readProtocol(std::string_view text, std::string_view name);

/// Reads a file with readProtocol(). Message thread only.
Result<Protocol> loadProtocol(const std::filesystem::path& path);

/// `protocol` as JSON; readProtocol() restores it to the bit. Any thread.
std::string protocolJson(const Protocol& protocol);

/// The JSON schema (draft 2020-12) of protocol files, made from the table of their fields. Any thread.
std::string protocolSchema();

/// Hash of all fields as 16 hexadecimal digits. Any thread.
std::string protocolHash(const Protocol& protocol);

/// Built-in protocols in listing order. Created on first use; any thread.
const std::vector<Protocol>& builtInProtocols();

/// Built-in protocols, then their versions as published (ThesisVersions.h). Created on first use; any thread.
const std::vector<Protocol>& knownProtocols();

/// Deviations from the thesis' study; empty if the protocol is not one of knownProtocols() or has been
/// changed. Any thread (allocates).
std::vector<ThesisDeviation> deviationsOf(const Protocol& protocol);

/// Resolves a path in a protocol: the file in the protocol's folder if it exists, else the path itself.
/// Message thread only.
std::string besideProtocol(const std::string& folder, const std::string& path);

/// Empty, or an error if the file found by besideProtocol() is behind a link that leads out of the folder.
/// Message thread only.
std::string linkFault(const std::string& folder, const std::string& path);

/// One of knownProtocols() by name, else the protocol of a file, whose folder becomes `folder`. Message
/// thread only.
Result<Protocol> findProtocol(const std::string& nameOrPath);

} // namespace physvib
