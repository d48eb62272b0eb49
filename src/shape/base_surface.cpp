// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/shape/base_surface.h"

#include <utility>

namespace droplet {

BaseSurface::BaseSurface(Sample sample) : sample_(std::move(sample)) {}

}  // namespace droplet
