// SPDX-License-Identifier: GPL-3.0-or-later
// Writes a link in the format of the page's link.js, opens links, and starts the server of the page.
#include "Mixer/Window/PageLink.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneFile.h"
#include <cmath>
#include <juce_core/juce_core.h>
#include <string_view>

namespace physvib {
namespace {

constexpr int maxLinkedActuators = 8; // as many as the page has
constexpr int rawDeflateBits = -15;

/// Escapes as URLSearchParams does, except for commas and equals signs.
std::string urlEncoded(const std::string& text) {
    std::string encoded;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool isPlain = (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') ||
                             (byte >= 'A' && byte <= 'Z') ||
                             std::string_view{"*-._,="}.find(c) != std::string_view::npos;
        constexpr const char* digits = "0123456789ABCDEF";
        if (isPlain)
            encoded += c;
        else if (c == ' ')
            encoded += '+';
        else
            encoded += {'%', digits[byte / 16], digits[byte % 16]};
    }
    return encoded;
}

/// Deflated, in the base64 of URLs.
std::string deflatedBase64(const std::string& text) {
    juce::MemoryOutputStream bytes;
    {
        juce::GZIPCompressorOutputStream deflate{bytes, 9, rawDeflateBits};
        deflate.write(text.data(), text.size());
    }
    return juce::Base64::toBase64(bytes.getData(), bytes.getDataSize())
        .replaceCharacters("+/", "-_")
        .removeCharacters("=")
        .toStdString();
}

std::string shareText(double metres, double extentMetres) {
    return numberText(std::round(1000.0 * metres / extentMetres) / 1000.0);
}

} // namespace

Result<std::string> pageLink(const Mix& mix, const Scene& scene) {
    const auto& layout = mix.layout.geometry;
    if (layout.count > maxLinkedActuators)
        return Failure{"A link holds at most " + std::to_string(maxLinkedActuators) + " actuators, found " +
                       std::to_string(layout.count)};
    if (mix.exponent != 1.0) return Failure{"A link holds no exponent: expected 1"};
    const Scene* const builtIn = findBuiltInScene(scene.name);
    const bool isBuiltIn = builtIn != nullptr && *builtIn == scene;
    std::string link = "scene=" + urlEncoded(isBuiltIn ? scene.name : scene.name + ".json");
    if (!isBuiltIn) link += "&file=" + deflatedBase64(sceneJson(scene));
    if (mix.seed != 1) link += "&seed=" + std::to_string(mix.seed);
    std::string places;
    for (int j = 0; j < layout.count; ++j) {
        const auto& place = nth(layout.places, j);
        if (place.zMetres != 0.0 || place.part != 0)
            return Failure{"A link holds actuators of a plane: expected no depth and no parts of the body"};
        if (j > 0) places += ' ';
        places += shareText(place.xMetres, layout.extentWidthMetres) + ",";
        places += shareText(place.yMetres, layout.extentHeightMetres);
    }
    if (places != "0,1 1,1 0,0 1,0") link += "&at=" + urlEncoded(places); // the page's own four corners
    if (mix.law != PanningLaw::automatic) link += "&law=" + urlEncoded(std::string{nameOf(mix.law)});
    return link;
}

bool isLoopback(const juce::String& address) {
    const auto host = address.contains("://") ? address.fromFirstOccurrenceOf("://", false, false) : address;
    return host.startsWith("127.") || host.startsWith("[::1]") || host.startsWithIgnoreCase("localhost");
}

// juce::URL would escape the separators after the #. On some systems a shell parses the link.
void openLink(juce::String link) {
    for (const char c : std::string_view{"\"$`\\ "})
        link = link.replace(juce::String::charToString(c), juce::String{urlEncoded({c})}.replace("+", "%20"));
    juce::Process::openDocument(link, {});
}

juce::File PageServer::pageFolder() {
    auto folder = juce::File::getSpecialLocation(juce::File::currentExecutableFile).getParentDirectory();
    for (; !folder.isRoot(); folder = folder.getParentDirectory())
        for (const char* path : {"build/web/page", "physvib-page", "share/physvib/physvib-page"})
            if (folder.getChildFile(path).getChildFile("serve.py").existsAsFile())
                return folder.getChildFile(path);
    return {};
}

Result<std::string> PageServer::start() {
    const auto folder = pageFolder();
    juce::String line;
    if (program_.start({"python3", folder.getChildFile("serve.py").getFullPathName(), "--with-parent",
                        folder.getFullPathName()}))
        for (char c = 0; program_.readProcessOutput(&c, 1) == 1 && c != '\n';)
            line << juce::String::charToString(c);
    const auto address = line.upToFirstOccurrenceOf(" ", false, false);
    if (address.startsWith("https://")) return (address + "/").toStdString();
    return Failure{"The page is not served: " +
                   (line.isEmpty() ? std::string{"expected python3"} : line.toStdString())};
}

} // namespace physvib
