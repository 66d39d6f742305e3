// SPDX-License-Identifier: MIT
// Reads sweep designs: a list of values per factor. A task number is decoded as one digit per factor.
#include "Lab/Files/SweepFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Files/SweepText.h"
#include <algorithm>
#include <array>

namespace physvib {
namespace {

constexpr const char* sweepVersionField = "physvib_sweep";
constexpr int largestSeed = 1'000'000'000;

struct SweepList {
    const char *name, *factor;
};
constexpr std::array<SweepList, 3> sweepLists{
    {{"layouts", "layout"}, {"laws", "law"}, {"methods", "method"}}};

std::string readWord(const JsonField& json, SweepWord kind, const std::string& name = {}) {
    const std::string word = json.isNumber() ? numberText(json.number()) : json.text();
    if (const auto fault = sweepWordFault(kind, name, word); !fault.empty()) json.fail(fault);
    return word;
}

template <class Item>
void expectOnce(const JsonField& json, const std::vector<Item>& found, const Item& next,
                const std::string& words) {
    if (std::ranges::find(found, next) != found.end())
        json.fail("expected each only once, found " + words + " again");
}

std::size_t sizeOfList(const JsonField& json) {
    const std::size_t size = json.arraySize();
    if (size < 1 || size > limits::maxSweepValues)
        json.fail("expected 1 to " + std::to_string(limits::maxSweepValues) + " items, found " +
                  std::to_string(size));
    return size;
}

/// A single word, or a list of distinct words.
SweepFactor readFactor(const JsonField& json, const std::string& name, SweepWord kind = SweepWord::option) {
    SweepFactor factor{name, json.path(), {}};
    if (!json.isArray()) {
        factor.values.push_back(readWord(json, kind, name));
        return factor;
    }
    for (std::size_t i = 0, size = sizeOfList(json); i < size; ++i) {
        const std::string word = readWord(json.item(i), kind, name);
        expectOnce(json.item(i), factor.values, word, inQuotes(word));
        factor.values.push_back(word);
    }
    return factor;
}

SweepScene readSweepScene(const JsonField& json) {
    if (!json.isObject()) return {readWord(json, SweepWord::scene), {}};
    json.expectObject({"scene", "variables"});
    SweepScene scene{readWord(json["scene"], SweepWord::scene), {}};
    const JsonField variables = json["variables"];
    for (const std::string& name : variables.names()) {
        if (!isSweepVariable(name)) variables.fail("expected names of variables, found " + inQuotes(name));
        scene.variables.push_back(readFactor(variables[name], name, SweepWord::variable));
    }
    return scene;
}

std::uint32_t readSeed(const JsonField& json) {
    const int seed = json.wholeNumber();
    if (seed < 0)
        json.fail("expected a seed from 0 to " + std::to_string(largestSeed) + ", found " +
                  std::to_string(seed));
    return static_cast<std::uint32_t>(seed);
}

SweepSeeds readSeeds(const JsonField& json) {
    SweepSeeds seeds;
    if (json.isArray()) {
        for (std::size_t i = 0, size = sizeOfList(json); i < size; ++i) {
            const std::uint32_t seed = readSeed(json.item(i));
            expectOnce(json.item(i), seeds.list, seed, std::to_string(seed));
            seeds.list.push_back(seed);
        }
        return seeds;
    }
    json.expectObject({"from", "count"});
    seeds.first = readSeed(json["from"]);
    seeds.count = readSeed(json["count"]);
    if (seeds.count < 1) json["count"].fail("expected at least 1, found 0");
    return seeds;
}

std::vector<SweepFactor> readOptions(const JsonField& json) {
    constexpr std::array<std::string_view, 6> own{"scene", "set", "seed", "layout", "law", "method"};
    std::vector<SweepFactor> factors;
    for (const std::string& name : json.names()) {
        const bool isName = !name.empty() && std::ranges::all_of(name, [](char c) {
            return (c >= 'a' && c <= 'z') || c == '-';
        });
        if (!isName)
            json.fail("expected names of options of render without dashes in front, found " + inQuotes(name));
        if (std::ranges::find(own, name) != own.end())
            json.fail("expected " + inQuotes(name) + " in a field of its own");
        if (name == "sound") json.fail("expected \"sounds\" in a field of its own");
        factors.push_back(readFactor(json[name], name));
    }
    return factors;
}

/// Product of the list sizes, clamped just above the limit.
std::uint64_t productOf(const std::vector<SweepFactor>& factors, std::uint64_t product) {
    for (const SweepFactor& factor : factors)
        product = std::min<std::uint64_t>(product * factor.values.size(), limits::maxSweepTasks + 1);
    return product;
}

SweepDesign readSweepRoot(const JsonField& root) {
    checkVersion(root, sweepVersionField, sweepFormatVersion);
    root.expectObject(
        {sweepVersionField, "name", "scenes", "seeds", "layouts", "laws", "methods", "sounds", "options"});
    SweepDesign design{root["name"].text(), {}, {}, {}, {}};
    const JsonField scenes = root["scenes"];
    for (std::size_t i = 0, size = sizeOfList(scenes); i < size; ++i) {
        design.scenes.push_back(readSweepScene(scenes.item(i)));
        for (std::size_t k = 0; k < i; ++k)
            if (design.scenes[k].name == design.scenes[i].name)
                scenes.item(i).fail("expected each scene only once, found " +
                                    inQuotes(design.scenes[i].name) + " again");
    }
    design.seeds = readSeeds(root["seeds"]);
    for (const auto& [name, factor] : sweepLists)
        if (root.has(name)) design.factors.push_back(readFactor(root[name], factor));
    if (root.has("sounds")) design.sounds = readFactor(root["sounds"], "sound").values;
    if (root.has("options"))
        for (SweepFactor& factor : readOptions(root["options"])) design.factors.push_back(std::move(factor));
    if (const auto tasks = design.size(); tasks > limits::maxSweepTasks)
        root.fail("expected at most " + std::to_string(limits::maxSweepTasks) + " tasks, found more");
    return design;
}

/// Decodes the lowest digits of `index`, one per factor, and removes them.
std::vector<std::string> takeValues(const std::vector<SweepFactor>& factors, std::uint64_t& index) {
    std::vector<std::string> values(factors.size());
    for (std::size_t f = factors.size(); f-- > 0;) {
        const auto& from = factors[f].values;
        values[f] = from[index % from.size()];
        index /= from.size();
    }
    return values;
}

} // namespace

std::uint64_t SweepDesign::size() const noexcept {
    std::uint64_t sum = 0;
    for (const SweepScene& scene : scenes)
        sum +=
            productOf(factors, productOf(scene.variables,
                                         std::min<std::uint64_t>(seeds.size(), limits::maxSweepTasks + 1)));
    return sum;
}

SweepTask SweepDesign::task(std::uint64_t index) const {
    auto scene = scenes.begin();
    for (;; ++scene) {
        const std::uint64_t tasks = productOf(factors, productOf(scene->variables, seeds.size()));
        if (index < tasks) break;
        index -= tasks;
    }
    SweepTask task{scene->name, {}, {}, seeds.at(index % seeds.size()), {}};
    index /= seeds.size();
    task.options = takeValues(factors, index);
    task.variables = takeValues(scene->variables, index);
    task.call = sweepCall(task, *scene, *this);
    return task;
}

Result<SweepDesign> readSweep(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxSweepFileBytes,
                    [](const Json& root) { return readSweepRoot(JsonField(root, {})); });
}

} // namespace physvib
