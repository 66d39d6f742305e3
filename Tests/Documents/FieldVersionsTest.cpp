// SPDX-License-Identifier: MIT
// A field that older files lack makes a new version of its format.
#include "Live/Documents/DocumentJson.h"
#include "Live/Documents/PluginState.h"
#include <algorithm>
#include <gtest/gtest.h>

namespace physvib {
namespace {

/// Finds the newest field of a table.
template <class T>
struct NewestField {
    const T object{};
    int since = 1;

    void version(std::string_view, int) {}
    void field(std::string_view, const auto&, const auto&, Need need = Need::required) { see(need); }
    void formerly(std::string_view, const auto&, const auto&) {}
    void part(std::string_view, Need need = Need::required) { see(need); }
    bool has(std::string_view, const auto&) { return true; }
    void see(Need need) { since = std::max(since, need.since); }
};

template <class... Tables>
int newestOf() {
    const auto newest = []<class T>(FieldsOf<T> table) {
        NewestField<T> fields;
        visitFields(fields, table);
        return fields.since;
    };
    return std::max({newest(FieldsOf<Tables>{})...});
}

TEST(FieldVersions, TheNewestFieldOfASessionIsOfTheVersionThatIsWritten) {
    EXPECT_EQ((newestOf<SavedSession, SceneRun, WorldStall, CollisionEvent, RecordingsChange, RecordingFile,
                        ClipFile, EventShaping, Mix, StripGroup, Strip>()),
              sessionFormatVersion);
}

TEST(FieldVersions, TheNewestFieldOfAPluginStateIsOfTheVersionThatIsWritten) {
    EXPECT_EQ((newestOf<PluginState, NoteVoice, ControllerRule>()), pluginStateVersion);
}

} // namespace
} // namespace physvib
