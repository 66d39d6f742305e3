// SPDX-License-Identifier: MIT
// The outer shape of a protocol file; its fields are read and written after the table in ProtocolFields.h.
#include "Files/ProtocolFile.h"
#include "Files/Disk/ContentHash.h"
#include "Files/Disk/Embedded.h"
#include "Files/Disk/FileLimits.h"
#include "Files/Json/JsonFile.h"
#include "Files/Json/JsonReader.h"
#include "Files/Json/JsonVersion.h"
#include "Files/Json/JsonWriter.h"
#include "Files/Text/NumberText.h"
#include "Files/ProtocolFields.h"
#include "Files/TrialColumns.h"
#include "Physics/Scenes/SceneRanges.h"

namespace physvib {
namespace {

constexpr const char* protocolVersionField = "physvib_protocol";

Protocol readProtocolRoot(Json& root) {
    checkVersion(JsonField(root, {}), protocolVersionField, protocolFormatVersion);
    root.erase(protocolVersionField);
    auto protocol = readFields<Protocol>(JsonField(root, {}));
    if (const std::string fault = detail::checkFields("", protocol, 0); !fault.empty()) throw JsonError({}, fault);
    if (const std::string fault = validate(protocol); !fault.empty()) throw JsonError({}, fault);
    for (const std::string& scale : scalesOf(protocol))
        if (trialColumns::has(scale)) throw JsonError({}, "scales: expected names that no other column of a trial file has, found " + inQuotes(scale));
    return protocol;
}

} // namespace

Result<Protocol> readProtocol(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxProtocolFileBytes, readProtocolRoot);
}

Result<Protocol> loadProtocol(const std::filesystem::path& path) {
    return loadText(path, limits::maxProtocolFileBytes, readProtocol);
}

std::string protocolJson(const Protocol& protocol) {
    OrderedJson root = {{protocolVersionField, protocolFormatVersion}};
    root.update(detail::fieldsJson(protocol, {}));
    return jsonLines(root);
}

std::string protocolHash(const Protocol& protocol) { return contentHash(protocolJson(protocol)); }

const std::vector<Protocol>& builtInProtocols() {
    static const std::vector<Protocol> protocols = readEmbedded(embeddedProtocols(), readProtocol);
    return protocols;
}

Result<Protocol> findProtocol(const std::string& nameOrPath) {
    if (isJsonPath(nameOrPath)) return loadProtocol(nameOrPath);
    for (const Protocol& protocol : builtInProtocols())
        if (protocol.name == nameOrPath) return protocol;
    return Failure{"no protocol " + inQuotes(nameOrPath) + " (see physvib study list)"};
}

} // namespace physvib
