// SPDX-License-Identifier: MIT
// Reads and writes protocol files by the table in ProtocolFields.h, writes their JSON schema, and applies the
// edits that make a protocol run as published.
#include "Lab/Files/ProtocolFile.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/FileClash.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFields.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/Protocol.h"
#include "Scene/SceneJson.h"
#include "Scene/SceneRanges.h"
#include <algorithm>
#include <iterator>
#include <type_traits>

namespace physvib {
// Source/Lab/Protocols/*.json, in listing order
const std::vector<EmbeddedFile>& embeddedProtocols();

namespace {

Protocol readProtocolRoot(Json& root) {
    checkVersion(JsonField(root, {}), protocolVersionField, protocolFormatVersion);
    root.erase(protocolVersionField);
    root.erase("$schema"); // names the schema to editors
    auto protocol = readFields<Protocol>(JsonField(root, {}));
    if (const std::string error = detail::checkFields("", protocol, 0); !error.empty())
        throw JsonError({}, error);
    if (const std::string error = validate(protocol); !error.empty()) throw JsonError({}, error);
    for (const std::string& scale : protocolScales(protocol))
        if (trialColumns::has(scale))
            throw JsonError({}, "scales: expected names that no other column of a trial file has, found " +
                                    inQuotes(scale));
    return protocol;
}

Result<std::vector<StimulusLevel>> readStimulusLevels(std::string_view text, std::string_view name) {
    std::vector<StimulusLevel> levels;
    try {
        const detail::StudyRows rows{text, name};
        const auto condition = rows.requireColumn("condition"), stimulus = rows.requireColumn("stimulus"),
                   alternative = rows.requireColumn("alternative"), level = rows.requireColumn("level_db");
        for (const CsvRow& row : rows.table().rows) {
            StimulusLevel next{rows.text(row, condition), rows.text(row, stimulus),
                               rows.text(row, alternative),
                               rows.number(row, level, -limits::maxLevelDb, limits::maxLevelDb)};
            if (findLevel(levels, next.condition, next.stimulus) != nullptr)
                throw detail::StudyTableError{
                    rows.table().cellError(row, stimulus, "each stimulus of a condition once")};
            levels.push_back(std::move(next));
        }
    } catch (const detail::StudyTableError& error) {
        return Failure{error.message};
    }
    return levels;
}

/// Loads the sessions' levels_file. Returns an error line or an empty string.
std::string loadLevelsFiles(Protocol& protocol) {
    const auto session =
        std::ranges::find_if(protocol.sessions, [](const SessionPlan& s) { return !s.levelsFile.empty(); });
    if (session == protocol.sessions.end()) return {};
    const auto path = resolveProtocolPath(protocol.folder, session->levelsFile);
    const auto text = readFile(path, limits::maxTableBytes);
    if (!text) return text.error;
    auto levels = readStimulusLevels(text.value, path);
    if (!levels) return levels.error;
    protocol.levels = std::move(levels.value);
    return levelsError(protocol);
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
    return prettyJson(root);
}

std::string protocolHash(const Protocol& protocol) {
    return contentHash(protocolJson(protocol) +
                       (protocol.levels.empty() ? std::string{} : stimulusLevelsCsv(protocol.levels, {})));
}

const std::vector<Protocol>& builtInProtocols() {
    static const std::vector<Protocol> protocols = readEmbedded(embeddedProtocols(), readProtocol);
    return protocols;
}

const std::vector<Protocol>& knownProtocols() {
    static const std::vector<Protocol> known = [] {
        std::vector<Protocol> all = builtInProtocols();
        all.insert(all.end(), thesisVersions().begin(), thesisVersions().end());
        return all;
    }();
    return known;
}

std::vector<ThesisDeviation> findDeviations(const Protocol& protocol) {
    const auto& known = knownProtocols();
    std::vector<ThesisDeviation> deviations;
    if (std::ranges::find(known, protocol) == known.end()) return deviations;
    const std::string_view name = protocol.name;
    const bool isAsPublished = name.ends_with(thesisSuffix);
    const std::string_view builtIn = isAsPublished ? name.substr(0, name.size() - thesisSuffix.size()) : name;
    std::ranges::copy_if(
        thesisDeviations, std::back_inserter(deviations), [&](const ThesisDeviation& deviation) {
            return deviation.protocol == builtIn && !(isAsPublished && deviation.edit != ThesisEdit::none);
        });
    return deviations;
}

std::string resolveProtocolPath(const std::string& folder, const std::string& path) {
    std::error_code ignored;
    const auto fullPath = std::filesystem::path{folder} / path;
    return !folder.empty() && std::filesystem::is_regular_file(fullPath, ignored) ? fullPath.string() : path;
}

std::string linkError(const std::string& folder, const std::string& path) {
    std::error_code ignored;
    const std::string found = resolveProtocolPath(folder, path),
                      home = found == path ? std::string{} : folder;
    if (!isPlainPath(path) || !std::filesystem::exists(found, ignored) || isWithin(home, found)) return {};
    return found + ": expected a file in " + (home.empty() ? "the folder" : home) +
           " or below, found a link that leads elsewhere";
}

namespace {

/// Checks all paths in a protocol with linkError(), except those in calls.
std::string firstLinkError(const Protocol& protocol) {
    std::vector<std::string> paths{protocol.translation};
    for (const ConditionPlan& condition : protocol.conditions) paths.push_back(condition.layout);
    for (const StudySoundFile& sound : protocol.sounds)
        paths.push_back(sound.file); // a participant's pictures are checked by the mixer's StudyLooks
    for (const SessionPlan& session : protocol.sessions) paths.push_back(session.levelsFile);
    for (const std::string& path : paths)
        if (auto error = linkError(protocol.folder, path); !error.empty()) return error;
    return {};
}

} // namespace

Result<Protocol> findProtocol(const std::string& nameOrPath) {
    if (isJsonPath(nameOrPath)) {
        auto protocol = loadProtocol(nameOrPath);
        if (!protocol) return protocol;
        protocol.value.folder = std::filesystem::path{nameOrPath}.parent_path().string();
        if (auto error = firstLinkError(protocol.value); !error.empty()) return Failure{error};
        if (auto error = loadLevelsFiles(protocol.value); !error.empty()) return Failure{error};
        return protocol;
    }
    for (const Protocol& protocol : knownProtocols())
        if (protocol.name == nameOrPath) return protocol;
    return Failure{"no protocol " + inQuotes(nameOrPath) + " (see physvib study list)"};
}

namespace {

template <class T>
OrderedJson objectSchema();

OrderedJson makeSchema(const bool&, const Bounds&) { return {{"type", "boolean"}}; }
OrderedJson makeSchema(const std::string&, const Bounds& bounds) {
    OrderedJson schema{{"type", "string"}};
    if (bounds.max > 0.0 && bounds.max < Bounds{}.max)
        schema["maxLength"] = static_cast<std::size_t>(bounds.max);
    return schema;
}
template <class Number>
requires std::is_arithmetic_v<Number> OrderedJson makeSchema(const Number&, const Bounds& bounds) {
    OrderedJson schema{{"type", std::is_integral_v<Number> ? "integer" : "number"}};
    if (bounds.min > Bounds{}.min) schema["minimum"] = bounds.min;
    if (bounds.max < Bounds{}.max) schema["maximum"] = bounds.max;
    return schema;
}
template <class T>
requires std::is_class_v<T> OrderedJson makeSchema(const T&, const Bounds&) { return objectSchema<T>(); }
template <class T>
OrderedJson makeSchema(const std::optional<T>&, const Bounds& bounds) {
    return makeSchema(T{}, bounds);
}
template <class T>
OrderedJson makeSchema(const std::vector<T>&, const Bounds& bounds) {
    OrderedJson schema{{"type", "array"}, {"items", makeSchema(T{}, bounds)}, {"minItems", bounds.minItems}};
    if (bounds.maxItems > 0) schema["maxItems"] = bounds.maxItems;
    return schema;
}

/// Collects the JSON schema of T from its table of fields.
template <class T>
struct SchemaWriter {
    OrderedJson properties = OrderedJson::object(), required = OrderedJson::array(),
                cases = OrderedJson::array();

    template <class F>
    void field(std::string_view name, F T::*, const Bounds& bounds, Need need) {
        properties[std::string(name)] = makeSchema(F{}, bounds);
        if (need == Need::required) required.push_back(std::string(name));
    }
    void choice(std::string_view name, const auto&, const auto& names) {
        properties[std::string(name)] = {{"enum", names}};
    }
    template <class... Kinds>
    void variant(std::string_view name, std::variant<Kinds...> T::*, const auto& names) {
        choice(name, nullptr, names);
        required.push_back(std::string(name));
        std::size_t index = 0;
        (add<Kinds>(std::string(name), std::string(names[index++])), ...);
    }

private:
    /// The fields of one kind, and those that it needs.
    template <class Kind>
    void add(const std::string& name, const std::string& kind) {
        SchemaWriter<Kind> kindWriter;
        visitFields(kindWriter, FieldsOf<Kind>{});
        for (const auto& [key, schema] : kindWriter.properties.items()) properties[key] = schema;
        cases.push_back({{"if", {{"properties", {{name, {{"const", kind}}}}}}},
                         {"then", {{"required", kindWriter.required}}}});
    }
};

template <class T>
OrderedJson objectSchema() {
    SchemaWriter<T> writer;
    visitFields(writer, FieldsOf<T>{});
    OrderedJson schema{{"type", "object"},
                       {"properties", writer.properties},
                       {"required", writer.required},
                       {"additionalProperties", false}};
    if (!writer.cases.empty()) schema["allOf"] = writer.cases;
    return schema;
}

} // namespace

std::string protocolSchema() {
    OrderedJson schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                       {"title", "PhysVib study protocol"}};
    schema.update(objectSchema<Protocol>());
    OrderedJson& properties = schema["properties"];
    properties[protocolVersionField] = {
        {"type", "integer"}, {"minimum", 1}, {"maximum", protocolFormatVersion}};
    properties["$schema"] = {{"type", "string"}};
    schema["required"].push_back(protocolVersionField);
    return prettyJson(schema);
}

// Applies the edit of each deviation; deviations without an edit remain deviations of the edited version.

namespace {

/// Each call of the protocol, which may be changed.
template <class EditCall>
void forEachCall(Protocol& protocol, EditCall editCall) {
    for (ConditionPlan& condition : protocol.conditions)
        std::visit(
            [&editCall](auto& set) {
                if constexpr (requires { set.call; }) editCall(set.call);
            },
            condition.stimuli);
}

void edit(Protocol& protocol, const ThesisDeviation& deviation) {
    switch (deviation.edit) {
    case ThesisEdit::none: break;
    case ThesisEdit::noBreakBefore:
        for (SessionPlan& session : protocol.sessions) session.breakBeforeSeconds = 0.0;
        break;
    case ThesisEdit::noGroups:
        for (ConditionPlan& condition : protocol.conditions) condition.group.clear();
        break;
    case ThesisEdit::addToCalls:
        forEachCall(protocol, [&deviation](std::string& call) {
            call.append(" ").append(deviation.change, addedWordsPrefix.size(),
                                    deviation.change.size() - addedWordsPrefix.size() -
                                        addedWordsSuffix.size());
        });
        break;
    case ThesisEdit::matchPeaks:
        forEachCall(protocol, [words = std::string_view{"--sound-match rms"}](std::string& call) {
            if (const auto at = call.find(words); at != call.npos)
                call.replace(at, words.size(), "--sound-match peak");
        });
        break;
    }
}

std::vector<Protocol> makeVersions() {
    std::vector<Protocol> versions;
    for (Protocol protocol : builtInProtocols()) {
        const Protocol builtIn = protocol;
        for (const ThesisDeviation& deviation : thesisDeviations)
            if (deviation.protocol == builtIn.name) edit(protocol, deviation);
        if (protocol == builtIn) continue;
        protocol.name.append(thesisSuffix);
        protocol.title += ", as published";
        versions.push_back(std::move(protocol));
    }
    return versions;
}

} // namespace

const std::vector<Protocol>& thesisVersions() {
    static const std::vector<Protocol> versions = makeVersions();
    return versions;
}

} // namespace physvib
