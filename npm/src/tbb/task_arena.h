// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tbb {

class task_arena {
public:
    explicit task_arena(int) {}

    template <typename Task>
    auto execute(const Task& task)
    {
        return task();
    }
};

namespace this_task_arena {

template <typename Task>
auto isolate(const Task& task)
{
    return task();
}

}  // namespace this_task_arena
}  // namespace tbb
