// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a link as the page's link.js does.
#include "Mixer/Window/PageLink.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneFile.h"
#include <cmath>
#include <juce_core/juce_core.h>
#include <string_view>

namespace physvib {
namespace {

constexpr int maxLinked = 8; // actuators of the page
constexpr int rawDeflate = -15;

/// Escapes as URLSearchParams does, except for commas and equals signs.
std::string encoded(const std::string& text) {
    std::string made;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool isPlain = (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') ||
                             (byte >= 'A' && byte <= 'Z') ||
                             std::string_view{"*-._,="}.find(c) != std::string_view::npos;
        constexpr const char* digits = "0123456789ABCDEF";
        if (isPlain)
            made += c;
        else if (c == ' ')
            made += '+';
        else
            made += {'%', digits[byte / 16], digits[byte % 16]};
    }
    return made;
}

/// Deflated, in the base64 of URLs.
std::string packed(const std::string& text) {
    juce::MemoryOutputStream bytes;
    {
        juce::GZIPCompressorOutputStream deflate{bytes, 9, rawDeflate};
        deflate.write(text.data(), text.size());
    }
    return juce::Base64::toBase64(bytes.getData(), bytes.getDataSize())
        .replaceCharacters("+/", "-_")
        .removeCharacters("=")
        .toStdString();
}

std::string share(double place, double extent) {
    return numberText(std::round(1000.0 * place / extent) / 1000.0);
}

} // namespace

Result<std::string> pageLink(const Mix& mix, const Scene& drawn) {
    const auto& layout = mix.layout.geometry;
    if (layout.count > maxLinked)
        return Failure{"A link holds at most " + std::to_string(maxLinked) + " actuators, found " +
                       std::to_string(layout.count)};
    if (mix.exponent != 1.0) return Failure{"A link holds no exponent: expected 1"};
    const Scene* const known = findBuiltInScene(drawn.name);
    const bool isKnown = known != nullptr && *known == drawn;
    std::string link = "scene=" + encoded(isKnown ? drawn.name : drawn.name + ".json");
    if (!isKnown) link += "&file=" + packed(sceneJson(drawn));
    if (mix.seed != 1) link += "&seed=" + std::to_string(mix.seed);
    std::string places;
    for (int j = 0; j < layout.count; ++j) {
        const auto& place = nth(layout.places, j);
        if (place.zMetres != 0.0 || place.part != 0)
            return Failure{"A link holds actuators of a plane: expected no depth and no parts of the body"};
        if (j > 0) places += ' ';
        places += share(place.xMetres, layout.extentWidthMetres) + ",";
        places += share(place.yMetres, layout.extentHeightMetres);
    }
    if (places != "0,1 1,1 0,0 1,0") link += "&at=" + encoded(places); // the page's own four corners
    if (mix.law != PanningLaw::automatic) link += "&law=" + encoded(std::string{nameOf(mix.law)});
    return link;
}

bool isLoopback(const juce::String& address) {
    const auto host = address.contains("://") ? address.fromFirstOccurrenceOf("://", false, false) : address;
    return host.startsWith("127.") || host.startsWith("[::1]") || host.startsWithIgnoreCase("localhost");
}

// juce::URL would escape what separates the parts behind the #. A shell reads the words on some systems.
void openLink(juce::String link) {
    for (const char c : std::string_view{"\"$`\\ "})
        link = link.replace(juce::String::charToString(c), juce::String{encoded({c})}.replace("+", "%20"));
    juce::Process::openDocument(link, {});
}

juce::File PageServer::page() {
    auto folder = juce::File::getSpecialLocation(juce::File::currentExecutableFile).getParentDirectory();
    for (; !folder.isRoot(); folder = folder.getParentDirectory())
        for (const char* at : {"build/web/page", "physvib-page", "share/physvib/physvib-page"})
            if (folder.getChildFile(at).getChildFile("serve.py").existsAsFile())
                return folder.getChildFile(at);
    return {};
}

Result<std::string> PageServer::begin() {
    const auto folder = page();
    juce::String words;
    if (program_.start({"python3", folder.getChildFile("serve.py").getFullPathName(), "--with-parent",
                        folder.getFullPathName()}))
        for (char c = 0; program_.readProcessOutput(&c, 1) == 1 && c != '\n';)
            words << juce::String::charToString(c);
    const auto address = words.upToFirstOccurrenceOf(" ", false, false);
    if (address.startsWith("https://")) return (address + "/").toStdString();
    return Failure{"The page is not served: " +
                   (words.isEmpty() ? std::string{"expected python3"} : words.toStdString())};
}

} // namespace physvib
