// SPDX-License-Identifier: GPL-3.0-or-later
// Finds the window's host of cards, and closes a card before its answer is used.
#include "Mixer/Window/CardHost.h"

namespace physvib {
namespace {

CardHost* hostOf(juce::Component& from) { return from.findParentComponentOfClass<CardHost>(); }

using From = juce::Component::SafePointer<juce::Component>;

/// Later, because the click of the card's button is still being handled.
void closeThen(const From& from, std::function<void()> then) {
    juce::MessageManager::callAsync([safe = from, then = std::move(then)] {
        if (safe == nullptr) return;
        if (auto* host = hostOf(*safe)) host->setCard(nullptr);
        if (then) then();
    });
}

} // namespace

void askForFile(juce::Component& from, const FileCard::Choice& choice,
                std::function<void(const juce::File&)> use, std::function<void()> cancelled) {
    askForFiles(
        from, choice, [use = std::move(use)](const juce::Array<juce::File>& files) { use(files[0]); },
        std::move(cancelled));
}

void askForFiles(juce::Component& from, const FileCard::Choice& choice,
                 const std::function<void(const juce::Array<juce::File>&)>& use,
                 std::function<void()> cancelled) {
    auto* host = hostOf(from);
    if (host == nullptr) return;
    auto card = std::make_unique<FileCard>(choice);
    card->onCancel = [safe = From{&from}, cancelled = std::move(cancelled)] { closeThen(safe, cancelled); };
    card->onFile = [safe = From{&from}, use](const juce::File& file) {
        closeThen(safe, [use, file] { use({file}); });
    };
    card->onFiles = [safe = From{&from}, use](const juce::Array<juce::File>& files) {
        closeThen(safe, [use, files] { use(files); });
    };
    host->setCard(std::move(card));
}

void askForValues(juce::Component& from, const juce::String& title, const juce::String& answer,
                  const std::vector<QuestionCard::Field>& fields,
                  std::function<void(const juce::StringArray&)> use) {
    auto* host = hostOf(from);
    if (host == nullptr) return;
    const auto card = std::make_shared<juce::Component::SafePointer<QuestionCard>>();
    std::vector<QuestionCard::Answer> answers{{answer,
                                               [safe = From{&from}, card, fields, use = std::move(use)] {
                                                   juce::StringArray values;
                                                   for (const auto& field : fields)
                                                       values.add((*card)->value(field.title));
                                                   closeThen(safe, [use, values] { use(values); });
                                               }},
                                              {"Cancel", [safe = From{&from}] { closeThen(safe, {}); }, true,
                                               juce::KeyPress{juce::KeyPress::escapeKey}}};
    auto made = std::make_unique<QuestionCard>(title, juce::String{}, std::move(answers), fields);
    *card = made.get();
    host->setCard(std::move(made));
}

} // namespace physvib
