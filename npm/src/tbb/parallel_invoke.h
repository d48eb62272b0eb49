// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tbb {

template <typename... Work>
void parallel_invoke(const Work&... work)
{
    (work(), ...);
}

}  // namespace tbb
