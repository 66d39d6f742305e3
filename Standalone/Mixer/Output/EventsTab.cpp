// SPDX-License-Identifier: GPL-3.0-or-later
// Updates the list a few times a second; saves selected contacts, or writes them to the files of a drag.
#include "Mixer/Output/EventsTab.h"
#include "Core/NameNumbers.h"
#include "Io/Text/NameList.h"
#include "Live/Recordings/HitExport.h"
#include "Mixer/Widgets/Cards.h"
#include <filesystem>
#include <iterator>
#include <limits>

namespace physvib {
namespace {

constexpr int eventRowPixels = 22, eventHeadPixels = 18, formatPixels = 26, footPixels = formatPixels + 6;
constexpr double listIntervalMs = 250.0;
constexpr std::size_t maxListedContacts = 1000; // a minute of many hits

constexpr int minWideRow = 560; // pixels at which every column has room

struct Columns {
    juce::Rectangle<int> time, dot, name, frequency, decay, level, actuator, place;
    explicit Columns(juce::Rectangle<int> row) {
        row.reduce(10, 0);
        row.getWidth() < minWideRow ? placeNarrow(row) : placeWide(row);
    }

private:
    void placeWide(juce::Rectangle<int> row) {
        const int columnWidth = row.getWidth() / 8;
        time = row.removeFromLeft(columnWidth);
        dot = row.removeFromLeft(20);
        place = row.removeFromRight(columnWidth + 24);
        actuator = row.removeFromRight(columnWidth - 12);
        level = row.removeFromRight(columnWidth - 22);
        decay = row.removeFromRight(columnWidth - 6);
        frequency = row.removeFromRight(columnWidth - 6);
        name = row;
    }
    // Number columns are of fixed width. If names had too little room, decay is left out, then the place.
    void placeNarrow(juce::Rectangle<int> row) {
        constexpr int numberWidth = 50, actuatorWidth = 64, placeWidth = 92, minNameWidth = 96;
        time = row.removeFromLeft(60);
        dot = row.removeFromLeft(20);
        const auto hasRoom = [&row](int extraWidth) {
            return row.getWidth() - 2 * numberWidth - actuatorWidth - extraWidth >= minNameWidth;
        };
        const bool hasPlace = hasRoom(placeWidth),
                   hasDecay = hasRoom(numberWidth + (hasPlace ? placeWidth : 0));
        if (hasPlace) place = row.removeFromRight(placeWidth);
        actuator = row.removeFromRight(actuatorWidth);
        level = row.removeFromRight(numberWidth);
        if (hasDecay) decay = row.removeFromRight(numberWidth);
        frequency = row.removeFromRight(numberWidth);
        name = row;
    }
};

juce::String timeText(std::int64_t ns) { return number(1e-9 * static_cast<double>(ns), 3) + " s"; }
/// The material's name; for a rolling or sliding contact also its kind and its number of grains.
juce::String contactName(const Scene& scene, const RecentContact& contact) {
    const auto name = materialName(scene, contact.event);
    const auto kind = contact.event.source.kind;
    if (kind == ContactKind::hit) return name;
    return name + (kind == ContactKind::roll ? ", rolls, " : ", slides, ") +
           countText(contact.grainCount, "grain");
}

juce::String positionText(const CollisionEvent& hit) {
    return number(hit.x, 2) + ", " + number(hit.y, 2) + " m";
}

/// Sorts the hits and shifts their times, so that the first is at 0.
void shiftToZero(std::vector<CollisionEvent>& hits) {
    std::ranges::stable_sort(hits, {}, &CollisionEvent::timeNs);
    const std::int64_t firstNs = hits.front().timeNs;
    for (CollisionEvent& hit : hits) hit.timeNs -= firstNs;
}

/// Creates a folder for this user alone. False: that failed, or the folder existed, maybe of another user.
bool createPrivateFolder(const std::filesystem::path& folder) {
    std::error_code code;
    if (!std::filesystem::create_directory(folder, code)) return false;
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, code);
    return !code;
}

Result<WrittenHits> writeClip(const HitExport& hits, const PhantomPanner& panner, const std::string& path,
                              ClipFormat format) {
    EventClipSettings settings;
    settings.channels = static_cast<std::size_t>(panner.channels());
    settings.gains = [&panner](const CollisionEvent& event, PhantomPanner::Gains& gains) {
        gains = {};
        panner.gainsAt(event, gains);
    };
    const auto clip = makeHitClip(hits, settings);
    if (!clip) return Failure{clip.error};
    const auto parts = splitClip(clip.value, path, format);
    WrittenHits written;
    if (auto error = replacedPartError(parts, path); !error.empty()) return Failure{std::move(error)};
    for (const ClipPart& part : parts) written.paths.push_back(part.path);
    if (const auto result = writeParts(parts, format); !result) return Failure{result.error};
    written.losses = listLosses(parts, format);
    return written;
}

} // namespace

EventsTab::EventsTab(MixerModel& model)
    : model_{model} {
    setTitle("Events");
    list_.setTitle("List of played events");
    list_.setRowHeight(eventRowPixels);
    list_.setMultipleSelectionEnabled(true);
    selectionLabel_.setMinimumHorizontalScale(1.0f); // two lines rather than narrow letters
    for (int k = 0; k < hitFileExtensions().size(); ++k)
        format_.addItem("as " + hitFileExtensions()[k], k + 1);
    std::vector<std::string_view> multichannel, mono;
    for (const ClipFormatInfo& row : clipFormats) (row.isMono ? mono : multichannel).push_back(row.ending);
    describe(format_, "Dragged as",
             hitFileExtensions()[0] + ": a channel for each actuator. " + utf8(nameList(multichannel)) +
                 ": channels and places. " + utf8(nameList(mono)) + ": a file for each actuator");
    format_.setSelectedItemIndex(files_->formatIndex(), dontNotify);
    format_.onChange = [this] { files_->setFormatIndex(format_.getSelectedItemIndex()); };
    save_ = makeLinkButton("Save as clip" + ellipsis(), "Save the chosen contacts as a clip (Return)",
                           [this] { saveAs(); });
    addAll(*this, {&list_, &selectionLabel_, &format_, save_.get()});
    showSelection();
}

// Rows do not change while a mouse button is down.
void EventsTab::refresh(const MixerSnapshot& snapshot) {
    const double now = nowMs();
    if (snapshot.session.render.played == playedCount_ || now - updatedAtMs_ < listIntervalMs ||
        list_.isMouseButtonDown(true))
        return;
    updatedAtMs_ = now;
    playedCount_ = snapshot.session.render.played;
    updateRows();
}

// While contacts are selected, old contacts stay in the list up to its limit; selected ones stay beyond it.
void EventsTab::updateRows() {
    const auto& recent = model_.recentContacts().newestFirst();
    std::vector<RecentContact> items(recent.begin(), recent.end());
    const std::uint64_t oldestId = recent.empty() ? 0 : recent.back().id;
    std::ranges::copy_if(contacts_, std::back_inserter(items), [&](const RecentContact& c) {
        return c.id < oldestId &&
               (isContactSelected(c) || (!selectedIds_.empty() && items.size() < maxListedContacts));
    });
    const int rowBefore = findRow(lastClickedId_);
    contacts_ = std::move(items);
    {
        const juce::ScopedValueSetter<bool> updating{isUpdatingRows_, true};
        list_.updateContent();
        restoreSelection();
    }
    if (const int row = findRow(lastClickedId_); rowBefore >= 0 && row >= 0) // its place on the screen stays
        list_.getViewport()->setViewPosition(0, list_.getViewport()->getViewPositionY() +
                                                    (row - rowBefore) * eventRowPixels);
    showSelection();
    list_.repaint();
    repaint(0, 0, getWidth(), eventHeadPixels); // a scroll bar moves the columns
}

void EventsTab::restoreSelection() {
    juce::SparseSet<int> rows;
    for (int row = 0; row < getNumRows(); ++row)
        if (const auto& contact = nth(contacts_, row);
            isContactSelected(contact) && contact.id != lastClickedId_)
            rows.addRange({row, row + 1});
    list_.setSelectedRows(rows, dontNotify);
    if (const int last = findRow(lastClickedId_); last >= 0)
        list_.selectRow(last, true, false); // Shift extends the selection from it
}

int EventsTab::findRow(std::uint64_t contactId) const {
    const auto found = std::ranges::find(contacts_, contactId, &RecentContact::id);
    return found == contacts_.end() ? -1 : static_cast<int>(found - contacts_.begin());
}

void EventsTab::selectedRowsChanged(int row) {
    if (isUpdatingRows_) return;
    selectedIds_.clear();
    const auto rows = list_.getSelectedRows();
    for (int k = 0; k < rows.size(); ++k) selectedIds_.insert(nth(contacts_, rows[k]).id);
    lastClickedId_ = row >= 0 ? nth(contacts_, row).id : 0;
    showSelection();
}

void EventsTab::showSelection() {
    save_->setEnabled(!selectedIds_.empty());
    if (selectedIds_.empty())
        return selectionLabel_.setText(isNarrow() ? "Choose some, then drag them out"
                                                  : "Choose contacts, then drag them into another program",
                                       dontNotify);
    std::int64_t firstNs = std::numeric_limits<std::int64_t>::max(), lastNs = 0;
    for (const RecentContact& contact : contacts_)
        if (isContactSelected(contact))
            firstNs = std::min(firstNs, contact.event.timeNs), lastNs = std::max(lastNs, contact.lastGrainNs);
    selectionLabel_.setText(
        countText(selectedIds_.size(), "contact") +
            (lastNs > firstNs ? " within " + timeText(lastNs - firstNs) : juce::String{}) +
            (isNarrow() ? "" : ", to be dragged out"),
        dontNotify);
}

juce::String EventsTab::getNameForRow(int row) {
    if (row < 0 || row >= getNumRows()) return {};
    const auto& contact = nth(contacts_, row);
    const auto& hit = contact.event;
    const auto& scene = model_.world().scene();
    return contactName(scene, contact) + " at " + timeText(hit.timeNs) + ", " +
           number(strongestActuatorFor(model_, hit).levelG, 2) + " g " + placeText(scene, hit);
}

void EventsTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= getNumRows()) return;
    const auto& contact = nth(contacts_, row);
    const auto& hit = contact.event;
    const auto& model = model_;
    if (isSelected) drawSelectedRow(g, *this, width, height);
    const Columns columns{{width, height}};
    const auto strongest = strongestActuatorFor(model, hit);
    const int material = findMaterialIndex(model.world().scene(), hit);
    g.setColour(material < 0 ? palette::grey : palette::material(model.world().scene().materials, material));
    g.fillEllipse(columns.dot.toFloat().withSizeKeepingCentre(10.0f, 10.0f).translated(-4.0f, 0.0f));
    const auto cell = [&](const juce::String& label, juce::Rectangle<int> area, Shade tone, bool isNumber) {
        g.setColour(shade(*this, tone));
        g.drawText(label, area,
                   isNumber ? juce::Justification::centredRight : juce::Justification::centredLeft, true);
    };
    g.setFont(text::font(text::small));
    cell(timeText(hit.timeNs), columns.time, Shade::muted, false);
    cell(contactName(model.world().scene(), contact), columns.name, Shade::text, false);
    const bool hasModes = !isClip(hit.sound);
    cell(hasModes ? number(hit.frequencyHz, 1) : "clip", columns.frequency, Shade::text, true);
    cell(hasModes ? number(hit.decayPerSecond, 1) : "", columns.decay, Shade::text, true);
    cell(number(strongest.levelG, 3), columns.level, Shade::text, true);
    cell(positionText(hit), columns.place, Shade::muted, true);
    g.setFont(text::font(text::small, juce::Font::bold));
    g.setColour(actuatorColour(*this, strongest.actuator));
    g.drawText(labelOf(model.mix(), strongest.actuator), columns.actuator, juce::Justification::centred,
               true);
}

void EventsTab::paint(juce::Graphics& g) {
    const Columns columns{getLocalBounds().withHeight(eventHeadPixels).withWidth(list_.getVisibleRowWidth())};
    setInk(g, *this, Shade::muted, text::small);
    const auto drawTitle = [&](const juce::String& title, juce::Rectangle<int> area,
                               juce::Justification side) { g.drawText(title, area, side, true); };
    drawTitle("Contact", columns.time, juce::Justification::centredLeft);
    drawTitle("Material", columns.name, juce::Justification::centredLeft);
    drawTitle("f Hz", columns.frequency, juce::Justification::centredRight);
    drawTitle(juce::String::charToString(0x03c4) + " 1/s", columns.decay, juce::Justification::centredRight);
    drawTitle("g", columns.level, juce::Justification::centredRight);
    drawTitle("most on", columns.actuator, juce::Justification::centred);
    drawTitle("x, y", columns.place, juce::Justification::centredRight);
}

void EventsTab::resized() {
    auto area = getLocalBounds().withTrimmedTop(eventHeadPixels);
    auto foot = area.removeFromBottom(footPixels);
    list_.setBounds(area);
    foot.removeFromTop(footPixels - formatPixels);
    const int buttonWidth = isNarrow() ? 98 : 110, buttonGap = isNarrow() ? 4 : gap;
    save_->setBounds(foot.removeFromRight(buttonWidth));
    foot.removeFromRight(buttonGap);
    format_.setBounds(foot.removeFromRight(buttonWidth));
    foot.removeFromRight(buttonGap);
    selectionLabel_.setBounds(foot.withTrimmedLeft(5));
    showSelection();
}

void EventsTab::showMenu() {
    juce::PopupMenu menu;
    menu.addItem("Save as clip" + ellipsis(), [safe = juce::Component::SafePointer<EventsTab>{this}] {
        if (safe != nullptr) safe->saveAs();
    });
    menu.showMenuAsync(juce::PopupMenu::Options{}.withMousePosition());
}

/// A file name from the scene's name and the time of the first selected contact.
juce::String EventsTab::fileName() const {
    std::int64_t firstNs = std::numeric_limits<std::int64_t>::max();
    for (const RecentContact& contact : contacts_)
        if (isContactSelected(contact)) firstNs = std::min(firstNs, contact.event.timeNs);
    return juce::File::createLegalFileName(utf8(model_.mix().scene->name) + "-" +
                                           juce::String{1e-9 * static_cast<double>(firstNs), 3} + "s") +
           hitFileExtensions()[files_->formatIndex()];
}

void EventsTab::saveAs() {
    if (selectedIds_.empty()) return;
    const auto folder = juce::SharedResourcePointer<UserFolder> {
        } -> location();
    const auto name = juce::File::createFileWithoutCheckingPath("/" + fileName());
    askForFile(*this,
               {"Save the chosen contacts as a clip", name.getFileExtension(), folder, true,
                name.getFileNameWithoutExtension(), hitFileExtensions()},
               [this](const juce::File& file) { saveTo(file); });
}

std::vector<juce::File> EventsTab::writeSelection(const juce::File& file, bool announcesResult) {
    std::vector<CollisionEvent> hits;
    for (const RecentContact& contact : contacts_)
        if (isContactSelected(contact)) model_.recentContacts().appendEvents(contact, hits);
    const auto written =
        writeHits(std::move(hits), model_.mix(), std::max(8000, model_.output().sampleRateHz()), file);
    if (!written) return model_.report(utf8(written.error)), std::vector<juce::File>{};
    std::vector<juce::File> files;
    for (const auto& path : written.value.paths) files.emplace_back(utf8(path));
    juce::StringArray notes{"Saved " + files.front().getFullPathName() +
                            (files.size() > 1
                                 ? " and " + juce::String{static_cast<int>(files.size()) - 1} + " more"
                                 : juce::String{})};
    for (const auto& loss : written.value.losses) notes.add(utf8(loss));
    if (announcesResult) model_.announce(notes.joinIntoString("; "));
    return files;
}

// The drop target receives escaped URLs.
juce::StringArray EventsTab::filesToDrag() {
    juce::StringArray addresses;
    if (selectedIds_.empty()) return addresses;
    const auto folder = files_->makeFolder();
    if (!folder) return model_.report(utf8(folder.error)), addresses;
    for (const auto& file : writeSelection(folder.value.getChildFile(fileName()), false))
        addresses.add(juce::URL{file}.toString(false));
    return addresses;
}

// Writes clip formats as `physvib export` does, or samples as .wav.

Result<WrittenHits> writeHits(std::vector<CollisionEvent> hits, const Mix& mix, int sampleRateHz,
                              const juce::File& path) {
    if (hits.empty()) return Failure{"Chosen contacts: expected one whose grains are still kept"};
    if (std::ranges::any_of(hits, [](const CollisionEvent& hit) { return isClip(hit.sound); }))
        return Failure{"Chosen contacts: expected hits, found a clip, which is a file already"};
    shiftToZero(hits);
    const auto panner = mix.panner();
    const auto name = pathOf(path);
    const HitExport hitExport{"Chosen contacts", path.getFileNameWithoutExtension().toStdString(), hits,
                              mix.layout, mix.layout.name};
    if (const auto format = findClipFormat(name)) return writeClip(hitExport, panner, name, *format);
    if (!path.hasFileExtension(hitFileExtensions()[0]))
        return Failure{name + ": expected a name that ends in " +
                       hitFileExtensions().joinIntoString(", ").toStdString()};
    const std::string error = writeHitsWav(hitExport, panner, sampleRateHz, name, "physvib " PHYSVIB_VERSION);
    return error.empty() ? Result<WrittenHits>{WrittenHits{{name}, {}}} : Result<WrittenHits>{Failure{error}};
}

Result<juce::File> DraggedFiles::makeFolder() {
    const auto tempFolder = juce::File::getSpecialLocation(juce::File::tempDirectory);
    if (!folder_.isDirectory()) {
        const auto newFolder = tempFolder.getChildFile("physvib-mixer-" + juce::Uuid{}.toString());
        if (!createPrivateFolder(pathOf(newFolder)))
            return Failure{pathOf(tempFolder) + ": expected a folder to write what is dragged into"};
        folder_ = newFolder;
    }
    const auto folder = folder_.getChildFile(juce::String{++dragCount_});
    if (const auto result = folder.createDirectory(); result.failed())
        return Failure{pathOf(folder) + ": " + result.getErrorMessage().toStdString()};
    return folder;
}

} // namespace physvib
