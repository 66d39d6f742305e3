// SPDX-License-Identifier: MIT
// A file says what it is, wherever it says so.
#include "Io/Disk/AtomicFile.h"
#include "Live/Documents/SessionFile.h"
#include "Scene/LayoutFile.h"
#include "Scene/SceneFile.h"
#include "Support/FileTesting.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

class FileKindTest : public FolderTest {
protected:
    FileKind kindOf(const std::string& text) const {
        EXPECT_EQ(writeFile(folder / "file.json", text), "");
        return fileKind(folder / "file.json");
    }
};

TEST_F(FileKindTest, IsToldByWhatWeWrite) {
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

TEST_F(FileKindTest, OfAnythingElseIsUnknown) {
    EXPECT_EQ(kindOf(""), FileKind::unknown);
    EXPECT_EQ(kindOf("RIFF physvib_session"), FileKind::unknown);
    EXPECT_EQ(fileKind(folder / "nowhere.json"), FileKind::unknown);
    EXPECT_EQ(fileKind(folder), FileKind::unknown);
}

} // namespace
} // namespace physvib
