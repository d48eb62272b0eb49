// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/installed.h"

#include <dlfcn.h>
#include <link.h>

#include <memory>
#include <vector>

namespace droplet {

namespace fs = std::filesystem;

namespace {

/// Folders in which the loader searches libraries for the given library.
std::vector<fs::path> searchedFolders(const char* library)
{
    std::vector<fs::path> folders;
    void* const ours = dlopen(*library == '\0' ? nullptr : library, RTLD_LAZY | RTLD_NOLOAD);
    Dl_serinfo size{};
    if (ours != nullptr && dlinfo(ours, RTLD_DI_SERINFOSIZE, &size) == 0) {
        const std::unique_ptr<std::byte[]> memory(new std::byte[size.dls_size]);
        auto* const info = new (memory.get()) Dl_serinfo(size);
        if (dlinfo(ours, RTLD_DI_SERINFO, info) == 0) {
            const Dl_serpath* const paths = info->dls_serpath;
            for (unsigned i = 0; i < info->dls_cnt; ++i) {
                folders.emplace_back(paths[i].dls_name);
            }
        }
    }
    if (ours != nullptr) {
        dlclose(ours);
    }
    return folders;
}

}  // namespace

std::optional<fs::path> installedFile(const char* name)
{
    static const char here = 0;
    Dl_info info{};
    void* map = nullptr;
    const bool known = dladdr1(&here, &info, &map, RTLD_DL_LINKMAP) != 0 && map != nullptr;
    const fs::path library = known ? static_cast<link_map*>(map)->l_name : "";
    std::error_code unknown;  // without /proc, the system's folders remain
    const fs::path own = (library.empty() ? fs::read_symlink("/proc/self/exe", unknown) : library).parent_path();
    std::vector<fs::path> folders{own / DROPLET_BESIDE_LIBRARY, own / DROPLET_BESIDE_COMMAND};
    for (fs::path& folder : searchedFolders(library.c_str())) {
        folders.push_back(std::move(folder));
    }
    for (const fs::path& folder : folders) {
        if (fs::exists(folder / name, unknown)) {
            return folder / name;
        }
    }
    return std::nullopt;
}

}  // namespace droplet
