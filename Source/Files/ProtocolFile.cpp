// SPDX-License-Identifier: MIT
// The outer shape of a protocol file; its fields are read and written after the table in ProtocolFields.h.
#include "Files/ProtocolFile.h"
#include "Files/Embedded.h"
#include "Files/FileLimits.h"
#include "Files/JsonFile.h"
#include "Files/JsonReader.h"
#include "Files/JsonVersion.h"
#include "Files/JsonWriter.h"
#include "Files/NumberText.h"
#include "Files/ProtocolFields.h"
#include "Files/TrialColumns.h"
#include "Physics/SceneRanges.h"
#include <cstdint>

namespace physvib {
namespace {

constexpr const char* versionField = "physvib_protocol";

bool isPath(std::string_view name) noexcept { return name.ends_with(".json") || name.find('/') != std::string_view::npos; }

Protocol readRoot(Json& root) {
    checkVersion(JsonField(root, {}), versionField, protocolFormatVersion);
    root.erase(versionField);
    auto protocol = readFields<Protocol>(JsonField(root, {}));
    if (const std::string fault = detail::checkFields("", protocol, 0); !fault.empty()) throw JsonError({}, fault);
    if (const std::string fault = validate(protocol); !fault.empty()) throw JsonError({}, fault);
    for (const std::string& scale : scalesOf(protocol))
        if (trialColumns::has(scale)) throw JsonError({}, "scales: expected names that no other column of a trial file has, found " + inQuotes(scale));
    return protocol;
}

} // namespace

Result<Protocol> readProtocol(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxProtocolFileBytes, readRoot);
}

Result<Protocol> loadProtocol(const std::filesystem::path& path) {
    return loadText(path, limits::maxProtocolFileBytes, readProtocol);
}

std::string protocolJson(const Protocol& protocol) {
    OrderedJson root = {{versionField, protocolFormatVersion}};
    root.update(detail::fieldsJson(protocol, {}));
    return jsonLines(root);
}

std::string protocolHash(const Protocol& protocol) {
    std::uint64_t hash = 0xCBF29CE484222325u; // FNV-1a
    for (const char c : protocolJson(protocol)) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += digits[hash >> shift & 15];
    return text;
}

const std::vector<Protocol>& builtInProtocols() {
    static const std::vector<Protocol> protocols = readEmbedded(embeddedProtocols(), readProtocol);
    return protocols;
}

Result<Protocol> findProtocol(const std::string& nameOrPath) {
    if (isPath(nameOrPath)) return loadProtocol(nameOrPath);
    for (const Protocol& protocol : builtInProtocols())
        if (protocol.name == nameOrPath) return protocol;
    return Failure{"no protocol " + inQuotes(nameOrPath) + " (see physvib study list)"};
}

} // namespace physvib
