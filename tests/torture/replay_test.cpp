// SPDX-License-Identifier: GPL-3.0-or-later
// Replays every picture that ever failed, in the ordinary tests.
#include <gtest/gtest.h>

#include "support/paths.h"
#include "torture/corpus.h"
#include "torture/trial.h"

namespace droplet::torture {
namespace {

TEST(TortureReplay, EveryPictureKept)
{
    const Corpus kept = files({testing::inSource("tests/torture/kept")});
    for (std::size_t k = 0; k < kept.count; ++k) {
        const Item item = kept.item(k);
        SCOPED_TRACE(item.name);
        for (std::size_t turn = 0; turn < kFills; ++turn) {
            const Verdict verdict = tryLibrary(item, fillOf(turn));
            EXPECT_TRUE(verdict.outcome != Outcome::Failed) << "fill " << turn << ": " << verdict.message;
        }
    }
}

}  // namespace
}  // namespace droplet::torture
