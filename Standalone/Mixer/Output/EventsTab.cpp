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
constexpr double showMs = 250.0;
constexpr std::size_t mostListed = 1000; // a minute of many hits

constexpr int wideRow = 560; // has room for every column

struct Columns {
    juce::Rectangle<int> time, dot, name, frequency, decay, level, enchanter, place;
    explicit Columns(juce::Rectangle<int> row) {
        row.reduce(10, 0);
        row.getWidth() < wideRow ? placeNarrow(row) : placeWide(row);
    }

private:
    void placeWide(juce::Rectangle<int> row) {
        const int each = row.getWidth() / 8;
        time = row.removeFromLeft(each);
        dot = row.removeFromLeft(20);
        place = row.removeFromRight(each + 24);
        enchanter = row.removeFromRight(each - 12);
        level = row.removeFromRight(each - 22);
        decay = row.removeFromRight(each - 6);
        frequency = row.removeFromRight(each - 6);
        name = row;
    }
    // Numbers as wide as they are; where names would have no room, decay is left out, then the place.
    void placeNarrow(juce::Rectangle<int> row) {
        constexpr int number = 50, mostWidth = 64, placeWidth = 92, minName = 96;
        time = row.removeFromLeft(60);
        dot = row.removeFromLeft(20);
        const auto hasRoom = [&row](int more) {
            return row.getWidth() - 2 * number - mostWidth - more >= minName;
        };
        const bool hasPlace = hasRoom(placeWidth), hasDecay = hasRoom(number + (hasPlace ? placeWidth : 0));
        if (hasPlace) place = row.removeFromRight(placeWidth);
        enchanter = row.removeFromRight(mostWidth);
        level = row.removeFromRight(number);
        if (hasDecay) decay = row.removeFromRight(number);
        frequency = row.removeFromRight(number);
        name = row;
    }
};

juce::String timeText(std::int64_t ns) { return number(1e-9 * static_cast<double>(ns), 3) + " s"; }
/// What sounds; of what rolls or slides also how, and how many grains it has passed.
juce::String nameOf(const Scene& scene, const RecentContact& contact) {
    const auto name = materialName(scene, contact.event);
    const auto kind = contact.event.source.kind;
    if (kind == ContactKind::hit) return name;
    return name + (kind == ContactKind::roll ? ", rolls, " : ", slides, ") + countOf(contact.grains, "grain");
}

juce::String placeNumbers(const CollisionEvent& hit) {
    return number(hit.x, 2) + ", " + number(hit.y, 2) + " m";
}

/// Sorts the hits and shifts their times, so that the first is at 0.
void startAtFirst(std::vector<CollisionEvent>& hits) {
    std::ranges::stable_sort(hits, {}, &CollisionEvent::timeNs);
    const std::int64_t first = hits.front().timeNs;
    for (CollisionEvent& hit : hits) hit.timeNs -= first;
}

/// Creates a folder for this user alone. False: that failed, or the folder existed, maybe of another user.
bool isMadeForUsAlone(const std::filesystem::path& folder) {
    std::error_code fault;
    if (!std::filesystem::create_directory(folder, fault)) return false;
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all, fault);
    return !fault;
}

Result<WrittenHits> writeClip(const HitExport& hits, const PhantomPanner& panner, const std::string& path,
                              ClipFormat format) {
    StrikeClipSettings drawn;
    drawn.channels = static_cast<std::size_t>(panner.channels());
    drawn.gains = [&panner](const CollisionEvent& event, PhantomPanner::Gains& gains) {
        gains = {};
        panner.gainsAt(event, gains);
    };
    const auto clip = clipOfHits(hits, drawn);
    if (!clip) return Failure{clip.error};
    const auto parts = partsOf(clip.value, path, format);
    WrittenHits written;
    for (const ClipPart& part : parts) {
        if (parts.size() > 1 && juce::File{part.path}.exists())
            return Failure{part.path + ": is there already; a file for each actuator replaces none"};
        written.paths.push_back(part.path);
    }
    if (const auto done = writeParts(parts, format); !done) return Failure{done.error};
    written.losses = lossesOf(parts, format);
    return written;
}

} // namespace

EventsTab::EventsTab(MixerModel& model)
    : model_{model} {
    setTitle("Events");
    list_.setTitle("List of played events");
    list_.setRowHeight(eventRowPixels);
    list_.setMultipleSelectionEnabled(true);
    choice_.setMinimumHorizontalScale(1.0f); // two lines rather than narrow letters
    for (int k = 0; k < hitEndings().size(); ++k) format_.addItem("as " + hitEndings()[k], k + 1);
    std::vector<std::string_view> whole, parted;
    for (const ClipFormatRow& row : clipFormats) (row.isMono ? parted : whole).push_back(row.ending);
    describe(format_, "Dragged as",
             hitEndings()[0] + ": a channel for each actuator. " + utf8(listed(whole)) +
                 ": channels and places. " + utf8(listed(parted)) + ": a file for each actuator");
    format_.setSelectedItemIndex(files_->ending(), quietly);
    format_.onChange = [this] { files_->setEnding(format_.getSelectedItemIndex()); };
    save_ = quietButton("Save as clip" + dots(), "Save the chosen contacts as a clip (Return)",
                        [this] { saveAs(); });
    addAll(*this, {&list_, &choice_, &format_, save_.get()});
    describeChoice();
}

// While a mouse button is down, the rows stay.
void EventsTab::refresh(const MixerMoment& moment) {
    const double now = nowMs();
    if (moment.session.render.played == seen_ || now - shownAtMs_ < showMs || list_.isMouseButtonDown(true))
        return;
    shownAtMs_ = now;
    seen_ = moment.session.render.played;
    listRecent();
}

// While contacts are selected, old ones stay in the list, up to its limit; selected ones stay beyond it.
void EventsTab::listRecent() {
    const auto& recent = model_.recent().newestFirst();
    std::vector<RecentContact> shown(recent.begin(), recent.end());
    const std::uint64_t oldest = recent.empty() ? 0 : recent.back().number;
    std::ranges::copy_if(shown_, std::back_inserter(shown), [&](const RecentContact& c) {
        return c.number < oldest && (isChosen(c) || (!chosen_.empty() && shown.size() < mostListed));
    });
    const int before = rowOf(last_);
    shown_ = std::move(shown);
    {
        const juce::ScopedValueSetter<bool> listing{isListing_, true};
        list_.updateContent();
        listChosen();
    }
    if (const int now = rowOf(last_); before >= 0 && now >= 0) // it stays where it is seen
        list_.getViewport()->setViewPosition(0, list_.getViewport()->getViewPositionY() +
                                                    (now - before) * eventRowPixels);
    describeChoice();
    list_.repaint();
    repaint(0, 0, getWidth(), eventHeadPixels); // a scroll bar moves the columns
}

void EventsTab::listChosen() {
    juce::SparseSet<int> rows;
    for (int row = 0; row < getNumRows(); ++row)
        if (const auto& contact = nth(shown_, row); isChosen(contact) && contact.number != last_)
            rows.addRange({row, row + 1});
    list_.setSelectedRows(rows, quietly);
    if (const int last = rowOf(last_); last >= 0) list_.selectRow(last, true, false); // from it Shift goes on
}

int EventsTab::rowOf(std::uint64_t number) const {
    const auto found = std::ranges::find(shown_, number, &RecentContact::number);
    return found == shown_.end() ? -1 : static_cast<int>(found - shown_.begin());
}

void EventsTab::selectedRowsChanged(int row) {
    if (isListing_) return;
    chosen_.clear();
    const auto rows = list_.getSelectedRows();
    for (int k = 0; k < rows.size(); ++k) chosen_.insert(nth(shown_, rows[k]).number);
    last_ = row >= 0 ? nth(shown_, row).number : 0;
    describeChoice();
}

void EventsTab::describeChoice() {
    save_->setEnabled(!chosen_.empty());
    if (chosen_.empty())
        return choice_.setText(isNarrow() ? "Choose some, then drag them out"
                                          : "Choose contacts, then drag them into another program",
                               quietly);
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), last = 0;
    for (const RecentContact& contact : shown_)
        if (isChosen(contact))
            first = std::min(first, contact.event.timeNs), last = std::max(last, contact.lastNs);
    choice_.setText(countOf(chosen_.size(), "contact") +
                        (last > first ? " within " + timeText(last - first) : juce::String{}) +
                        (isNarrow() ? "" : ", to be dragged out"),
                    quietly);
}

juce::String EventsTab::getNameForRow(int row) {
    if (row < 0 || row >= getNumRows()) return {};
    const auto& contact = nth(shown_, row);
    const auto& hit = contact.event;
    const auto& scene = model_.world().scene();
    return nameOf(scene, contact) + " at " + timeText(hit.timeNs) + ", " +
           number(strongestOf(model_, hit).levelG, 2) + " g " + placeText(scene, hit);
}

void EventsTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= getNumRows()) return;
    const auto& contact = nth(shown_, row);
    const auto& hit = contact.event;
    const auto& model = model_;
    if (isSelected) drawChosenRow(g, *this, width, height);
    const Columns at{{width, height}};
    const auto most = strongestOf(model, hit);
    const int material = materialOf(model.world().scene(), hit);
    g.setColour(material < 0 ? palette::other : palette::material(model.world().scene().materials, material));
    g.fillEllipse(at.dot.toFloat().withSizeKeepingCentre(10.0f, 10.0f).translated(-4.0f, 0.0f));
    const auto cell = [&](const juce::String& words, juce::Rectangle<int> area, Shade which, bool isNumber) {
        g.setColour(shade(*this, which));
        g.drawText(words, area,
                   isNumber ? juce::Justification::centredRight : juce::Justification::centredLeft, true);
    };
    g.setFont(text::font(text::small));
    cell(timeText(hit.timeNs), at.time, Shade::muted, false);
    cell(nameOf(model.world().scene(), contact), at.name, Shade::text, false);
    const bool isMode = !isClip(hit.sound);
    cell(isMode ? number(hit.frequencyHz, 1) : "clip", at.frequency, Shade::text, true);
    cell(isMode ? number(hit.decayPerSecond, 1) : "", at.decay, Shade::text, true);
    cell(number(most.levelG, 3), at.level, Shade::text, true);
    cell(placeNumbers(hit), at.place, Shade::muted, true);
    g.setFont(text::font(text::small, juce::Font::bold));
    g.setColour(enchanterColour(*this, most.enchanter));
    g.drawText(labelOf(model.mix(), most.enchanter), at.enchanter, juce::Justification::centred, true);
}

void EventsTab::paint(juce::Graphics& g) {
    const Columns at{getLocalBounds().withHeight(eventHeadPixels).withWidth(list_.getVisibleRowWidth())};
    ink(g, *this, Shade::muted, text::small);
    const auto head = [&](const juce::String& words, juce::Rectangle<int> area, juce::Justification where) {
        g.drawText(words, area, where, true);
    };
    head("Contact", at.time, juce::Justification::centredLeft);
    head("Material", at.name, juce::Justification::centredLeft);
    head("f Hz", at.frequency, juce::Justification::centredRight);
    head(juce::String::charToString(0x03c4) + " 1/s", at.decay, juce::Justification::centredRight);
    head("g", at.level, juce::Justification::centredRight);
    head("most on", at.enchanter, juce::Justification::centred);
    head("x, y", at.place, juce::Justification::centredRight);
}

void EventsTab::resized() {
    auto area = getLocalBounds().withTrimmedTop(eventHeadPixels);
    auto foot = area.removeFromBottom(footPixels);
    list_.setBounds(area);
    foot.removeFromTop(footPixels - formatPixels);
    const int button = isNarrow() ? 98 : 110, between = isNarrow() ? 4 : gap;
    save_->setBounds(foot.removeFromRight(button));
    foot.removeFromRight(between);
    format_.setBounds(foot.removeFromRight(button));
    foot.removeFromRight(between);
    choice_.setBounds(foot.withTrimmedLeft(5));
    describeChoice();
}

void EventsTab::showMenu() {
    juce::PopupMenu menu;
    menu.addItem("Save as clip" + dots(), [safe = juce::Component::SafePointer<EventsTab>{this}] {
        if (safe != nullptr) safe->saveAs();
    });
    menu.showMenuAsync(juce::PopupMenu::Options{}.withMousePosition());
}

/// From the scene's name and the time of the first contact.
juce::String EventsTab::fileName() const {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    for (const RecentContact& contact : shown_)
        if (isChosen(contact)) first = std::min(first, contact.event.timeNs);
    return juce::File::createLegalFileName(utf8(model_.mix().scene->name) + "-" +
                                           juce::String{1e-9 * static_cast<double>(first), 3} + "s") +
           hitEndings()[files_->ending()];
}

void EventsTab::saveAs() {
    if (chosen_.empty()) return;
    const auto folder = juce::SharedResourcePointer<UserFolder> {
        } -> place();
    const auto name = juce::File::createFileWithoutCheckingPath("/" + fileName());
    askForFile(*this,
               {"Save the chosen contacts as a clip", name.getFileExtension(), folder, true,
                name.getFileNameWithoutExtension(), hitEndings()},
               [this](const juce::File& file) { saveTo(file); });
}

std::vector<juce::File> EventsTab::write(const juce::File& file, bool saysHow) {
    std::vector<CollisionEvent> hits;
    for (const RecentContact& contact : shown_)
        if (isChosen(contact)) model_.recent().appendEvents(contact, hits);
    const auto written =
        writeHits(std::move(hits), model_.mix(), std::max(8000, model_.output().sampleRateHz()), file);
    if (!written) return model_.report(utf8(written.error)), std::vector<juce::File>{};
    std::vector<juce::File> files;
    for (const auto& path : written.value.paths) files.emplace_back(utf8(path));
    juce::StringArray words{"Saved " + files.front().getFullPathName() +
                            (files.size() > 1
                                 ? " and " + juce::String{static_cast<int>(files.size()) - 1} + " more"
                                 : juce::String{})};
    for (const auto& loss : written.value.losses) words.add(utf8(loss));
    if (saysHow) model_.announce(words.joinIntoString("; "));
    return files;
}

// As escaped URLs, which the drop target receives.
juce::StringArray EventsTab::filesToDrag() {
    juce::StringArray addresses;
    if (chosen_.empty()) return addresses;
    const auto folder = files_->makeFolder();
    if (!folder) return model_.report(utf8(folder.error)), addresses;
    for (const auto& file : write(folder.value.getChildFile(fileName()), false))
        addresses.add(juce::URL{file}.toString(false));
    return addresses;
}

// Writes clip formats as `physvib export` does, or samples.

Result<WrittenHits> writeHits(std::vector<CollisionEvent> hits, const Mix& mix, int sampleRateHz,
                              const juce::File& path) {
    if (hits.empty()) return Failure{"Chosen contacts: expected one whose grains are still kept"};
    if (std::ranges::any_of(hits, [](const CollisionEvent& hit) { return isClip(hit.sound); }))
        return Failure{"Chosen contacts: expected hits, found a clip, which is a file already"};
    startAtFirst(hits);
    const auto panner = mix.panner();
    const auto name = pathOf(path);
    const HitExport made{"Chosen contacts", path.getFileNameWithoutExtension().toStdString(), hits,
                         mix.layout, mix.layout.name};
    if (const auto format = clipFormatOf(name)) return writeClip(made, panner, name, *format);
    if (!path.hasFileExtension(hitEndings()[0]))
        return Failure{name + ": expected a name that ends in " +
                       hitEndings().joinIntoString(", ").toStdString()};
    const std::string error = writeHitsWav(made, panner, sampleRateHz, name, "physvib " PHYSVIB_VERSION);
    return error.empty() ? Result<WrittenHits>{WrittenHits{{name}, {}}} : Result<WrittenHits>{Failure{error}};
}

Result<juce::File> DraggedFiles::makeFolder() {
    const auto everyones = juce::File::getSpecialLocation(juce::File::tempDirectory);
    if (!folder_.isDirectory()) {
        const auto own = everyones.getChildFile("physvib-mixer-" + juce::Uuid{}.toString());
        if (!isMadeForUsAlone(pathOf(own)))
            return Failure{pathOf(everyones) + ": expected a folder to write what is dragged into"};
        folder_ = own;
    }
    const auto folder = folder_.getChildFile(juce::String{++drags_});
    if (const auto made = folder.createDirectory(); made.failed())
        return Failure{pathOf(folder) + ": " + made.getErrorMessage().toStdString()};
    return folder;
}

} // namespace physvib
