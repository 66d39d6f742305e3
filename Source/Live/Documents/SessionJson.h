// SPDX-License-Identifier: MIT
// Parts that whole session files and journals have in common. For the .cpp files of Files.
#pragma once
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonLines.h"
#include "Live/Documents/SessionFile.h"
#include <initializer_list>
#include <string_view>

namespace physvib::detail {

// Reading; all throw JsonError.
std::int64_t readTime(const JsonField& seconds);
/// What stands before the lists; `others` may stand beside it.
SavedSession readSessionHead(const JsonField& root, std::initializer_list<std::string_view> others);
SceneTake readTakeStart(const JsonField& json, const SceneTake* before);
WorldStall readStall(const JsonField& json, const SceneTake& take); ///< not before the last of the take
void readTimedControl(const JsonField& json, SavedSession& session);
void readRecordingsChange(const JsonField& json, SessionLog& log);
CollisionEvent readStrike(const JsonField& json);
void readClipFile(const JsonField& json, SessionLog& log);

// Writing.
double seconds(std::int64_t ns);
OrderedJson sessionHeadJson(const SavedSession& session, bool isJournal);
OrderedJson takeStartJson(const SceneTake& take, const SceneTake* before, bool withEnd);
OrderedJson inputJson(const LiveInput& input, const Scene& scene);
OrderedJson stallJson(const WorldStall& stall);
OrderedJson timedControlJson(const RenderControl& control);
OrderedJson recordingsJson(const RecordingsChange& change, const std::filesystem::path& folder);
OrderedJson strikeJson(const CollisionEvent& strike);
OrderedJson clipJson(const ClipFile& clip, const std::filesystem::path& folder);

} // namespace physvib::detail
