// SPDX-License-Identifier: GPL-3.0-or-later
// Runs droplets over one stray mesh of every kind, in the ordinary tests.
#include <gtest/gtest.h>

#include "torture/corpus.h"
#include "torture/trial.h"

namespace droplet::torture {
namespace {

TEST(StrayMeshes, OneOfEveryKind)
{
    const Corpus corpus = strayMeshes();
    for (std::size_t k = 0; k < corpus.count; k += 11) {
        const Item item = corpus.item(k);
        const Verdict verdict = corpus.trial(item);
        EXPECT_TRUE(verdict.outcome != Outcome::Failed) << item.name << ": " << verdict.message;
    }
}

}  // namespace
}  // namespace droplet::torture
