// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/liquid2d/particle_frame.h"

#include <gmock/gmock.h>

#include <limits>

#include "droplet/error.h"

namespace {

using droplet::Error;
using droplet::ParticleFrame;
using testing::HasSubstr;
using testing::ThrowsMessage;

ParticleFrame pair()
{
    return {
        .time = 0.0, .spacing = 0.1, .position = {{0, 0}, {0.1, 0}}, .velocity = {{}, {}}, .id = {3, 7}, .density = {}};
}

TEST(ParticleFrame, AcceptsFiniteParticlesWithUniqueIds)
{
    EXPECT_NO_THROW(pair().validate());
}

TEST(ParticleFrame, NamesTheParticleThatIsNotFinite)
{
    ParticleFrame frame = pair();
    frame.velocity[1].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT([&] { frame.validate(); }, ThrowsMessage<Error>(HasSubstr("particle 7 ")));
}

TEST(ParticleFrame, RefusesArraysOfDifferentSizesAndEqualIds)
{
    ParticleFrame frame = pair();
    frame.density = {1.0};
    EXPECT_THAT([&] { frame.validate(); }, ThrowsMessage<Error>(HasSubstr("density has 1 values for 2 particles")));
    frame = pair();
    frame.id = {3, 3};
    EXPECT_THAT([&] { frame.validate(); }, ThrowsMessage<Error>(HasSubstr("two particles have the id 3")));
}

}  // namespace
