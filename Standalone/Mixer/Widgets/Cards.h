// SPDX-License-Identifier: GPL-3.0-or-later
// Cards over the window: a choice of files, a question, the progress of rendering. Functions with which
// panels show them (askFor...), and classes that keep keyboard and mouse from the panels behind.
#pragma once
#include "Mixer/Widgets/MixerWidgets.h"
#include <atomic>

namespace physvib {

/// A card over the window: a title, a text, the content of a derived class, and answer buttons, the first at
/// the right. Its height follows its contents. Message thread.
class Card : public juce::Component {
public:
    void paint(juce::Graphics& g) override { drawCard(g, *this); }
    void resized() final;
    juce::String message() const { return messageLabel_.getText(); }

protected:
    static constexpr int cardRowHeight = 34, marginX = 24, marginY = 20, titleHeight = 30;

    explicit Card(int width);
    void setTexts(const juce::String& title, const juce::String& text);
    void setAnswers(std::vector<juce::TextButton*> answers); ///< Return presses the first, if it is enabled
    void fitToContents(); ///< adapts its size to its contents around its centre
    virtual int contentHeight() const = 0;
    virtual void placeContent(juce::Rectangle<int> content) = 0;
    virtual juce::Point<int> pictureArea() const { return {}; } ///< size of a picture at the left, in pixels

private:
    int answersHeight() const {
        return (static_cast<int>(answers_.size()) + answersPerRow() - 1) / answersPerRow() *
                   (cardRowHeight + gap) -
               gap;
    }
    int answersPerRow() const { return answers_.size() == 4 ? 4 : 3; } // no answer is alone in a row
    const int width_;
    juce::Label title_, messageLabel_;
    std::vector<juce::TextButton*> answers_;
};

/// Card over the window that asks for a file to open or to save, and lists a folder. A typed name stays while
/// another folder is entered; an existing file is replaced only after a second press. Message thread.
class FileCard final : public Card, private juce::ListBoxModel {
public:
    struct Choice {
        juce::String title, extension; ///< with its dot; added to a name without it. Empty: asks for a folder
        juce::File folder;
        bool isSaving = false;
        juce::String name{};                 ///< suggested, without its extension
        juce::StringArray otherExtensions{}; ///< also accepted
        bool allowsMultiple = false;         ///< several files can be selected, with Shift and Ctrl
    };

    explicit FileCard(const Choice& choice);

    std::function<void(const juce::Array<juce::File>&)> onFiles; ///< one, or several that were selected
    std::function<void()> onCancel;

    void openFolder(const juce::File& folder);
    const juce::File& folder() const noexcept { return folder_; }
    juce::String name() const { return name_.getText().trim(); }
    void setName(const juce::String& name) override { name_.setText(name, true); }
    juce::String error() const { return errorLabel_.getText(); }
    /// Same as Return: enters the selected folder, or accepts the file.
    void accept();

    bool keyPressed(const juce::KeyPress& key) override;

private:
    static constexpr int cardWidth = 640, minRows = 4, maxRows = 10; // a longer list scrolls
    int contentHeight() const override {
        return 8 + rowCount_ * list_.getRowHeight() + 3 * (rowHeight + gap);
    }
    void placeContent(juce::Rectangle<int> content) override;
    int getNumRows() override { return entries_.size(); }
    void paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) override;
    void selectedRowsChanged(int row) override {
        if (juce::isPositiveAndBelow(row, entries_.size()) && !entries_[row].isDirectory())
            setName(entries_[row].getFileNameWithoutExtension());
    }
    void listBoxItemDoubleClicked(int, const juce::MouseEvent&) override { accept(); }
    void returnKeyPressed(int) override { accept(); }
    juce::String getNameForRow(int row) override { return entries_[row].getFileName(); }
    void showNote(const juce::String& note, Shade tone);
    bool isFolder() const { return choice_.extension.isEmpty(); }
    juce::String acceptLabel() const {
        return isFolder() ? "Take this folder" : choice_.isSaving ? "Save" : "Open";
    }
    bool hasExtension(const juce::File& file) const;

    const Choice choice_;
    juce::File folder_;
    juce::Array<juce::File> entries_; // folders first
    juce::File fileToReplace_;        // existing file that the next press replaces
    Caption folderLabel_{{}, Shade::text}, errorLabel_;
    int rowCount_ = 0; // of the largest folder so far, so that the height does not jump
    juce::ListBox list_{"Files", this};
    juce::TextEditor name_;
    juce::TextButton up_{"Up"}, accept_, cancel_{"Cancel"};
};

constexpr int maxPictureSize = 450; ///< pixels of each side of a picture on a card

/// Dialogue card over the window, with fields to fill in: Return selects the first answer, buttons and keys
/// the others. Message thread.
class QuestionCard final : public Card {
public:
    static constexpr int cardWidth = 520;

    struct Answer {
        juce::String label;
        std::function<void()> onAnswer; ///< may destroy the card
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

    QuestionCard(const juce::String& title, const juce::String& message, std::vector<Answer> answers,
                 const std::vector<Field>& fields = {});
    ~QuestionCard() override;

    juce::String value(const juce::String& field) const; ///< typed or chosen; empty: no such field
    void setValue(const juce::String& field, const juce::String& value);
    void enableAnswer(const juce::String& answer, bool isEnabled);
    using Card::setTexts;

    /// Shows a picture beside the text, with sharp pixels; if it is null, `placeholder` is shown in its
    /// place. Unless `placeholder` is empty, the place is always as large as the largest picture.
    void setPicture(const juce::Image& picture, const juce::String& placeholder = {});
    const juce::String& placeholder() const noexcept { return placeholder_; }
    const juce::Image& picture() const noexcept { return picture_; }

    /// Same as a click on that button; no effect if it is missing or disabled.
    void answer(const juce::String& label);
    bool keyPressed(const juce::KeyPress& key) override;
    void paint(juce::Graphics& g) override;

private:
    class Input;
    void choose(std::size_t index);
    int contentHeight() const override { return static_cast<int>(inputs_.size()) * (rowHeight + gap); }
    void placeContent(juce::Rectangle<int> content) override;
    juce::Point<int> pictureArea() const override {
        return placeholder_.isEmpty() ? juce::Point{picture_.getWidth(), picture_.getHeight()}
                                      : juce::Point{maxPictureSize, maxPictureSize};
    }

    juce::Image picture_;
    juce::String placeholder_;
    std::vector<Answer> answers_;
    std::vector<std::unique_ptr<juce::TextButton>> buttons_;
    std::vector<std::unique_ptr<Input>> inputs_;
};

/// Creates a file in the background while the session plays: a small card with a progress bar and a cancel
/// button. It reports the result to `onDone`. Message thread.
class RenderTask final : public juce::Component, private juce::Thread, private juce::Timer {
public:
    /// Runs on its own thread, reports progress from 0 to 1, and stops when that returns false. Empty, or one
    /// error line; "cancelled".
    using Work = std::function<std::string(const std::function<bool(double)>& progress)>;
    using OnDone = std::function<void(const std::string& error, bool isCancelled)>; ///< may destroy the card

    RenderTask(const juce::File& file, Work work, OnDone onDone);
    ~RenderTask() override;

    const juce::File& file() const noexcept { return file_; }
    void paint(juce::Graphics& g) override;
    void resized() override { cancel_.setBounds(getLocalBounds().reduced(12, 13).removeFromRight(84)); }

    static constexpr int cardWidth = 340, cardHeight = 58;

private:
    void run() override;
    void timerCallback() override;

    const juce::File file_;
    const Work work_;
    const OnDone onDone_;
    std::atomic<double> progressShare_{0.0};
    std::string error_; // read after the thread has ended
    juce::TextButton cancel_{"Cancel"};
};

/// A component that shows cards over its panels.
class CardHost {
public:
    virtual ~CardHost() = default;
    /// Shows a card in the centre, with the keyboard; null: none.
    virtual void setCard(std::unique_ptr<juce::Component> card) = 0;
    /// Hides all panels behind a screen, which gets the keyboard; null: shows them again.
    virtual void setScreen(juce::Component* screen) = 0;
};

/// A link as a QR code, dark on white in any theme, at most maxPictureSize; null: it is too long. Any thread.
juce::Image qrPicture(const std::string& link);

/// Asks for one file or folder. As for the following functions: message thread; `onAccept` and `onCancelled`
/// are called after the card was closed, unless `opener` was deleted; without a host above it, no effect.
void askForFile(juce::Component& opener, const FileCard::Choice& choice,
                std::function<void(const juce::File&)> onAccept, std::function<void()> onCancelled = {});

/// Asks for one or several files; see FileCard::Choice::allowsMultiple.
void askForFiles(juce::Component& opener, const FileCard::Choice& choice,
                 const std::function<void(const juce::Array<juce::File>&)>& onAccept,
                 std::function<void()> onCancelled = {});

/// Asks for values: `onAccept` gets one per field. `acceptLabel`: text of the button that accepts them.
void askForValues(juce::Component& opener, const juce::String& title, const juce::String& acceptLabel,
                  const std::vector<QuestionCard::Field>& fields,
                  std::function<void(const juce::StringArray&)> onAccept, const juce::String& message = {});

/// Asks for the name and colour of a material of the scene, or of a copy of it, and restarts the world with
/// it. `onDone` gets its index. Message thread.
void askMaterial(juce::Component& opener, MixerModel& model, int material, bool isCopy,
                 std::function<void(int material)> onDone);
/// Shows a menu with both, and with two items that call `openPage`: for the material's page, and for a
/// recording from which the material is measured.
void showMaterialMenu(juce::Component& opener, MixerModel& model, int material,
                      std::function<void(int)> onDone, std::function<void(bool isRecording)> openPage);

/// Gives the keyboard to a card, or to its first text field, and keeps it there: when a menu window closes,
/// JUCE would return the keyboard to the component that had it before the card. Message thread.
class CardFocus final : private juce::FocusChangeListener {
public:
    CardFocus() { juce::Desktop::getInstance().addFocusChangeListener(this); }
    ~CardFocus() override { juce::Desktop::getInstance().removeFocusChangeListener(this); }

    /// Precondition: the card is visible.
    void focusCard(juce::Component& card) {
        card_ = &card;
        card.setFocusContainerType(juce::Component::FocusContainerType::keyboardFocusContainer); // for Tab
        auto* const field = findTextField(card);
        (field != nullptr ? *field : card).grabKeyboardFocus();
    }

private:
    static juce::Component* findTextField(juce::Component& parent) {
        for (auto* child : parent.getChildren()) {
            if (dynamic_cast<juce::TextEditor*>(child) != nullptr && child->isVisible()) return child;
            if (auto* const field = findTextField(*child)) return field;
        }
        return nullptr;
    }
    void globalFocusChanged(juce::Component* focused) override {
        if (card_ == nullptr || focused == nullptr || focused == card_ || card_->isParentOf(focused)) return;
        if (focused->getTopLevelComponent() == card_->getTopLevelComponent()) focusCard(*card_);
    }
    juce::Component::SafePointer<juce::Component> card_;
};

/// Lies between a card or an open menu and the window: the mouse reaches only the silence button through it,
/// and a press that closes a menu has no other effect. Message thread.
class ModalOverlay final : public juce::Component {
public:
    /// Shows or hides it; it is drawn only behind a card.
    void update(bool isBehindCard, bool isBehindMenu) {
        if (isBehindCard != std::exchange(isBehindCard_, isBehindCard)) repaint();
        if (const bool isDrawn = isBehindCard || isBehindMenu; isDrawn != isVisible()) {
            setVisible(isDrawn);
            if (isDrawn && !isBehindCard) toFront(false);
        }
    }
    void paint(juce::Graphics& g) override {
        if (!isBehindCard_) return;
        if (const auto* stop = findStopButton(*getParentComponent()))
            g.excludeClipRegion(getLocalArea(stop, stop->getLocalBounds()));
        g.fillAll(shade(*this, Shade::background).withAlpha(0.6f));
    }
    bool hitTest(int x, int y) override {
        const auto* stop = findStopButton(*getParentComponent());
        return stop == nullptr || !getLocalArea(stop, stop->getLocalBounds()).contains(x, y);
    }

private:
    static const juce::Component* findStopButton(const juce::Component& parent) {
        if (parent.getProperties()[stopProperty]) return &parent;
        for (const auto* child : parent.getChildren())
            if (child->isVisible())
                if (const auto* found = findStopButton(*child)) return found;
        return nullptr;
    }
    bool isBehindCard_ = false;
};

} // namespace physvib
