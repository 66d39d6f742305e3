// SPDX-License-Identifier: GPL-3.0-or-later
// Cards over the window: a choice of files, a question, the progress of rendering. Functions with which
// panels show them, and classes that keep keyboard and mouse from the panels behind.
#pragma once
#include "Mixer/Widgets/Parts.h"
#include <atomic>

namespace physvib {

/// A card over the window: a title, a text, the content of a derived class, and answer buttons, the first at
/// the right. Its height follows its contents. Message thread.
class Card : public juce::Component {
public:
    void paint(juce::Graphics& g) override { drawCard(g, *this); }
    void resized() final;
    juce::String words() const { return words_.getText(); }

protected:
    static constexpr int rowHigh = 34, edgeX = 24, edgeY = 20, titleHigh = 30;

    explicit Card(int width);
    void say(const juce::String& title, const juce::String& words);
    void setAnswers(std::vector<juce::TextButton*> answers); ///< Return presses the first, if it is enabled
    void fit(); ///< adapts its size to its contents around its centre
    virtual int contentHigh() const = 0;
    virtual void place(juce::Rectangle<int> content) = 0;
    virtual juce::Point<int> aside() const { return {}; } ///< size of a picture at the left, in pixels

private:
    int answersHigh() const {
        return (static_cast<int>(answers_.size()) + perRow() - 1) / perRow() * (rowHigh + gap) - gap;
    }
    int perRow() const { return answers_.size() == 4 ? 4 : 3; } // no answer is alone in a row
    const int width_;
    juce::Label title_, words_;
    std::vector<juce::TextButton*> answers_;
};

/// Card over the window that asks for a file to open or to save.
/// Lists a folder. A typed name stays while another folder is entered; a file that exists is replaced only
/// after a second press. Message thread.
class FileCard final : public Card, private juce::ListBoxModel {
public:
    struct Choice {
        juce::String title, ending; ///< with its dot; a name without an ending gets it. Empty: a folder
        juce::File folder;
        bool isSaving = false;
        juce::String name{};         ///< suggested, without its ending
        juce::StringArray endings{}; ///< others that are taken as well
        bool areSeveral = false;     ///< several files can be selected, with Shift and Ctrl
    };

    explicit FileCard(const Choice& choice);

    std::function<void(const juce::Array<juce::File>&)> onFiles; ///< one, or several that were selected
    std::function<void()> onCancel;

    void enter(const juce::File& folder);
    const juce::File& folder() const noexcept { return folder_; }
    juce::String name() const { return name_.getText().trim(); }
    void setName(const juce::String& name) override { name_.setText(name, true); }
    juce::String fault() const { return fault_.getText(); }
    /// Same as Return: enters a folder, or takes the file.
    void accept();

    bool keyPressed(const juce::KeyPress& key) override;

private:
    static constexpr int wide = 640, fewRows = 4, mostRows = 10; // a longer list scrolls
    int contentHigh() const override { return 8 + rows_ * list_.getRowHeight() + 3 * (rowHeight + gap); }
    void place(juce::Rectangle<int> content) override;
    int getNumRows() override { return entries_.size(); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void selectedRowsChanged(int row) override {
        if (juce::isPositiveAndBelow(row, entries_.size()) && !entries_[row].isDirectory())
            setName(entries_[row].getFileNameWithoutExtension());
    }
    void listBoxItemDoubleClicked(int, const juce::MouseEvent&) override { accept(); }
    void returnKeyPressed(int) override { accept(); }
    juce::String getNameForRow(int row) override { return entries_[row].getFileName(); }
    void showFault(const juce::String& words, Shade which);
    bool isFolder() const { return choice_.ending.isEmpty(); }
    juce::String acceptWords() const {
        return isFolder() ? "Take this folder" : choice_.isSaving ? "Save" : "Open";
    }
    bool hasEnding(const juce::File& file) const;

    const Choice choice_;
    juce::File folder_;
    juce::Array<juce::File> entries_; // folders first
    juce::File replaced_;             // existing file that the next press replaces
    Caption place_{{}, Shade::text}, fault_;
    int rows_ = 0; // of the largest folder so far, so that the height does not jump
    juce::ListBox list_{"Files", this};
    juce::TextEditor name_;
    juce::TextButton up_{"Up"}, accept_, cancel_{"Cancel"};
};

constexpr int mostPicture = 450; ///< pixels of a side

/// Dialogue card over the window, with fields to fill in: Return selects the first answer, buttons and keys
/// the others.
/// Message thread.
class QuestionCard final : public Card {
public:
    static constexpr int wide = 520;

    struct Answer {
        juce::String words;
        std::function<void()> act; ///< may destroy the card
        bool isEnabled = true;
        juce::KeyPress key{};
    };

    /// Asks for a text, or for one of some choices.
    struct Field {
        juce::String title, value;
        juce::String allowed{};                                                   ///< characters; empty: all
        juce::StringArray choices{};                                              ///< empty: any text
        std::function<void(QuestionCard&, const juce::String& value)> onChange{}; ///< chosen or typed
        std::vector<juce::Colour> dots{}; ///< of the choices, if these are colours
    };

    QuestionCard(const juce::String& title, const juce::String& words, std::vector<Answer> answers,
                 const std::vector<Field>& fields = {});
    ~QuestionCard() override;

    juce::String value(const juce::String& field) const; ///< as typed
    void setValue(const juce::String& field, const juce::String& value);
    void enable(const juce::String& answer, bool isEnabled);
    using Card::say;

    /// Shows a picture beside the text, with sharp pixels; if it is null, `without` is shown in its place.
    /// Unless `without` is empty, the place is always as large as the largest picture.
    void setPicture(const juce::Image& picture, const juce::String& without = {});
    const juce::String& withoutPicture() const noexcept { return without_; }
    const juce::Image& picture() const noexcept { return picture_; }

    /// Same as a click on that button; no effect if it is missing or disabled.
    void answer(const juce::String& words);
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;

private:
    class Input;
    void act(std::size_t which);
    int contentHigh() const override { return static_cast<int>(inputs_.size()) * (rowHeight + gap); }
    void place(juce::Rectangle<int> content) override;
    juce::Point<int> aside() const override {
        return without_.isEmpty() ? juce::Point{picture_.getWidth(), picture_.getHeight()}
                                  : juce::Point{mostPicture, mostPicture};
    }

    juce::Image picture_;
    juce::String without_;
    std::vector<Answer> answers_;
    std::vector<std::unique_ptr<juce::TextButton>> buttons_;
    std::vector<std::unique_ptr<Input>> inputs_;
};

/// Creates a file in the background while the session plays: a small card with a progress bar and a cancel
/// button. It reports the result to `done`. Message thread.
class RenderTask final : public juce::Component, private juce::Thread, private juce::Timer {
public:
    /// Runs on its own thread, reports progress from 0 to 1, and stops when that returns false. Empty, or one
    /// error line; "cancelled".
    using Work = std::function<std::string(const std::function<bool(double)>& progress)>;
    /// May destroy the card.
    using Done = std::function<void(const std::string& error, bool isCancelled)>;

    RenderTask(const juce::File& file, Work work, Done done);
    ~RenderTask() override;

    const juce::File& file() const noexcept { return file_; }
    void paint(juce::Graphics& g) override;
    void resized() override { cancel_.setBounds(getLocalBounds().reduced(12, 13).removeFromRight(84)); }

    static constexpr int wide = 340, high = 58;

private:
    void run() override;
    void timerCallback() override;

    const juce::File file_;
    const Work work_;
    const Done done_;
    std::atomic<double> share_{0.0};
    std::string error_; // read after the thread has ended
    juce::TextButton cancel_{"Cancel"};
};

/// A component that shows cards over its panels.
class CardHost {
public:
    virtual ~CardHost() = default;
    /// Shows a card in the centre, with the keyboard; null: none.
    virtual void setCard(std::unique_ptr<juce::Component> card) = 0;
    /// Hides all panels behind a screen, which gets the keys; null: shows them again.
    virtual void setScreen(juce::Component* screen) = 0;
};

/// A link as a QR code, dark on white in any theme, at most mostPicture; null: it is too long. Any thread.
juce::Image qrPicture(const std::string& link);

/// All for the message thread. `use` and `cancelled` are called later, after the card has gone, and not if
/// `from` has gone as well. Without a host above `from` nothing happens.
/// Asks for one file or folder.
void askForFile(juce::Component& from, const FileCard::Choice& choice,
                std::function<void(const juce::File&)> use, std::function<void()> cancelled = {});

/// Asks for one or several; see FileCard::Choice::areSeveral.
void askForFiles(juce::Component& from, const FileCard::Choice& choice,
                 const std::function<void(const juce::Array<juce::File>&)>& use,
                 std::function<void()> cancelled = {});

/// Asks for values: `use` gets one per field. `answer`: words of the button that accepts them.
void askForValues(juce::Component& from, const juce::String& title, const juce::String& answer,
                  const std::vector<QuestionCard::Field>& fields,
                  std::function<void(const juce::StringArray&)> use, const juce::String& words = {});

/// Asks for the name and colour of a material of the scene, or of a copy of it; the world begins anew with
/// it. `made` gets its index. Message thread.
void askMaterial(juce::Component& from, MixerModel& model, int material, bool isCopy,
                 std::function<void(int material)> made);
/// Shows a menu with both, and with two items that call `open`: the material's page, and a recording from
/// which it is measured.
void showMaterialMenu(juce::Component& from, MixerModel& model, int material, std::function<void(int)> made,
                      std::function<void(bool isRecording)> open);

/// Gives a card the keyboard, its first text field if it has one, and keeps it there. What would take it
/// away: a menu that is pressed by the mouse has a window of its own, and when that closes, JUCE gives the
/// keyboard to what had it before. Message thread.
class CardFocus final : private juce::FocusChangeListener {
public:
    CardFocus() { juce::Desktop::getInstance().addFocusChangeListener(this); }
    ~CardFocus() override { juce::Desktop::getInstance().removeFocusChangeListener(this); }

    /// The card is shown.
    void give(juce::Component& card) {
        card_ = &card;
        card.setFocusContainerType(juce::Component::FocusContainerType::keyboardFocusContainer); // for Tab
        auto* const field = fieldOf(card);
        (field != nullptr ? *field : card).grabKeyboardFocus();
    }

private:
    static juce::Component* fieldOf(juce::Component& in) {
        for (auto* child : in.getChildren()) {
            if (dynamic_cast<juce::TextEditor*>(child) != nullptr && child->isVisible()) return child;
            if (auto* const within = fieldOf(*child)) return within;
        }
        return nullptr;
    }
    void globalFocusChanged(juce::Component* focused) override {
        if (card_ == nullptr || focused == nullptr || focused == card_ || card_->isParentOf(focused)) return;
        if (focused->getTopLevelComponent() == card_->getTopLevelComponent()) give(*card_);
    }
    juce::Component::SafePointer<juce::Component> card_;
};

/// Lies between a card or an open menu and the window: only the button that silences is reached through it,
/// and a press that closes a menu does nothing else. Message thread.
class Curtain final : public juce::Component {
public:
    /// Shows or hides it; it is drawn only behind a card.
    void draw(bool isBehindCard, bool isBehindMenu) {
        if (isBehindCard != std::exchange(isBehindCard_, isBehindCard)) repaint();
        if (const bool isDrawn = isBehindCard || isBehindMenu; isDrawn != isVisible()) {
            setVisible(isDrawn);
            if (isDrawn && !isBehindCard) toFront(false);
        }
    }
    void paint(juce::Graphics& g) override {
        if (!isBehindCard_) return;
        if (const auto* stop = stopButton(*getParentComponent()))
            g.excludeClipRegion(getLocalArea(stop, stop->getLocalBounds()));
        g.fillAll(shade(*this, Shade::ground).withAlpha(0.6f));
    }
    bool hitTest(int x, int y) override {
        const auto* stop = stopButton(*getParentComponent());
        return stop == nullptr || !getLocalArea(stop, stop->getLocalBounds()).contains(x, y);
    }

private:
    static const juce::Component* stopButton(const juce::Component& in) {
        if (in.getProperties()[stopProperty]) return &in;
        for (const auto* child : in.getChildren())
            if (child->isVisible())
                if (const auto* found = stopButton(*child)) return found;
        return nullptr;
    }
    bool isBehindCard_ = false;
};

} // namespace physvib
