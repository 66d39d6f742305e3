// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's world as a link to the web page, which plays the same samples, and a server for that page.
#pragma once
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include <juce_events/juce_events.h>

namespace physvib {

/// The fragment of the page's address (after the #) with scene as drawn, seed, actuators and law; or one line
/// with what a link cannot hold. Places are rounded to thousandths of the field, as by the page. Any thread.
Result<std::string> pageLink(const Mix& mix, const Scene& scene);

/// Whether the address of a page reaches this computer only. Any thread.
bool isLoopback(const juce::String& address);

/// Opens the link, unchanged, in the system's browser. Message thread.
void openLink(juce::String link);

/// Serves the page by https to this network with its serve.py, for its own lifetime.
class PageServer {
public:
    ~PageServer() { program_.kill(); }
    /// Whether there is a page: in the tree where the mixer was built, in a release's folder physvib-page in
    /// or above the mixer's, or installed beside it in share/physvib. Any thread.
    static bool isAvailable() { return pageFolder() != juce::File{}; }
    /// The page's address for others, or one line. May wait for a second: not on the message thread.
    Result<std::string> start();

private:
    static juce::File pageFolder();
    juce::ChildProcess program_;
};

} // namespace physvib
