// SPDX-License-Identifier: GPL-3.0-or-later
// Shares the world as a link to the web page.
#include "Mixer/Window/MixerWindow.h"
#include "Mixer/Window/PageLink.h"

namespace physvib {
namespace {

constexpr const char *pageSetting = "page", *pageField = "Address of the page", *linkField = "Link";
constexpr const char* ownPage = "http://127.0.0.1:8000/"; // where Docs/web.md serves it

} // namespace

void MixerWindow::share() {
    const auto link = pageLink(desk_->mix(), desk_->world().drawing().drawn());
    if (!link) return say(utf8(link.error));
    const auto page = files_.settings().getValue(pageSetting, ownPage);
    const auto at = [behind = utf8(link.value)](const juce::String& address) {
        return address.upToFirstOccurrenceOf("#", false, false) + "#" + behind;
    };
    const auto whole = [this, at] {
        const auto address = view_->question()->value(pageField);
        files_.settings().setValue(pageSetting, address);
        view_->setCard(nullptr);
        return at(address);
    };
    const auto show = [at](QuestionCard& card, const juce::String& address) {
        card.setValue(linkField, at(address));
        card.setPicture(qrPicture(at(address).toStdString()));
    };
    ask("Share the world",
        "Who opens the link in the page gets the same world and samples. It stands behind the #, so no "
        "server gets it. A phone needs an address that it can reach.",
        {{"Copy the link",
          [this, whole] {
              const auto words = whole();
              juce::SystemClipboard::copyTextToClipboard(words);
              desk_->tell("Copied a link of " + juce::String{words.length()} + " characters");
          }},
         {"Open it", [whole] { openLink(whole()); }}},
        {{pageField, page, {}, {}, show}, {linkField, {}}});
    show(*view_->question(), page);
}

} // namespace physvib
