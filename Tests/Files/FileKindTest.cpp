// SPDX-License-Identifier: MIT
// A file says what it is, wherever it says so.
#include "Files/Disk/AtomicFile.h"
#include "Files/Disk/FileKind.h"
#include "Files/LayoutFile.h"
#include "Files/SceneCatalogue.h"
#include "Files/SceneFile.h"
#include "Files/SessionFile.h"
#include <cstdlib>
#include <gtest/gtest.h>

namespace physvib {
namespace {

FileKind kindOf(const std::string& text) {
    char name[] = "/tmp/physvib-kind-XXXXXX";
    const std::filesystem::path folder = mkdtemp(name);
    EXPECT_EQ(writeFile(folder / "file.json", text), "");
    const FileKind kind = fileKind(folder / "file.json");
    std::filesystem::remove_all(folder);
    return kind;
}

TEST(FileKind, IsToldByWhatWeWrite) {
    SavedSession session;
    session.channels = 1;
    session.log.takes.push_back({0, 0, 1, std::make_shared<const Scene>(*findBuiltInScene("drop")), {}, {}});
    session.mix = mixOf(session);
    EXPECT_EQ(kindOf(sessionJson(session)), FileKind::session) << "though its desk has a layout";
    EXPECT_EQ(kindOf(sceneJson(*findBuiltInScene("drop"))), FileKind::scene);
    EnchanterLayout ring;
    layoutPreset("ring3", ring);
    EXPECT_EQ(kindOf(layoutJson(describeLayout("ring", ring))), FileKind::layout);
}

TEST(FileKind, OfAnythingElseIsUnknown) {
    EXPECT_EQ(kindOf(""), FileKind::unknown);
    EXPECT_EQ(kindOf("RIFF physvib_session"), FileKind::unknown);
    EXPECT_EQ(fileKind("/nowhere.json"), FileKind::unknown);
    EXPECT_EQ(fileKind("/tmp"), FileKind::unknown);
}

} // namespace
} // namespace physvib
