// SPDX-License-Identifier: GPL-3.0-or-later
//
// resvg's package for npm, @resvg/resvg-wasm, is WebAssembly with the glue of wasm-bindgen. wasm2c (of WABT) has made C
// of it; see scripts/package-windows. Here are what that C needs of a system (wasm-rt.h), and the JavaScript values
// that the glue hands over by number: texts, bytes, lists of them.
//
// Every function of the C counts how deep it is called, and compares that with a limit. The limit is 0 after the time
// has run out, so that the next call ends the drawing, or the next turn of a loop.
#include "image/windows/resvg.h"

#include <index_bg.h>
#include <process.h>
#include <windows.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <thread>
#include <utility>
#include <variant>

namespace droplet {
namespace {

using Cause = ResvgError::Cause;

constexpr std::uint32_t kPage = 65536;  // bytes of memory by which WebAssembly counts
// resvg nests at most 1024 elements in one another, each in a few calls of less than 4 KiB of stack.
constexpr std::uint32_t kMaxDepth = 40'000;
constexpr unsigned kStack = 512U << 20U;  // addresses alone

// One drawing at a time: what follows is its state, as the C calls functions without one.
std::mutex one_at_a_time;
std::size_t memory_limit = 0;

/// A value of JavaScript.
struct Buffer {};  // the whole memory
struct View {      // bytes in the memory
    std::uint32_t begin;
    std::uint32_t size;
};
using Bytes = std::vector<std::uint8_t>;
using List = std::vector<std::uint32_t>;  // numbers of values
struct Iterator {
    List items;
    std::size_t next;
};
using Value = std::variant<std::monostate, Buffer, View, Bytes, List, Iterator, std::string>;

}  // namespace
}  // namespace droplet

// The names are wasm2c's.
// NOLINTBEGIN(readability-identifier-naming,cppcoreguidelines-avoid-non-const-global-variables)

/// What the imported functions share: all values, by number.
struct Z_wbg_instance_t {
    Z_index_bg_instance_t* module = nullptr;
    std::vector<droplet::Value> values;

    /// Numbers below 132 are reserved for undefined, null, true and false.
    static constexpr std::uint32_t kFirst = 132;

    std::uint32_t add(droplet::Value value)
    {
        values.push_back(std::move(value));
        return kFirst + static_cast<std::uint32_t>(values.size()) - 1;
    }

    template <class Kind>
    const Kind* find(std::uint32_t number) const
    {
        return number < kFirst || number - kFirst >= values.size() ? nullptr
                                                                   : std::get_if<Kind>(&values[number - kFirst]);
    }

    [[nodiscard]] std::uint8_t* memory() const { return module->w2c_memory.data; }

    /// Place of bytes in the memory, which the C knows to be inside.
    [[nodiscard]] std::uint8_t* at(std::uint32_t begin, std::uint64_t size) const
    {
        if (begin + size > module->w2c_memory.size) {
            wasm_rt_trap(WASM_RT_TRAP_OOB);
        }
        return memory() + begin;
    }
    [[nodiscard]] std::string text(std::uint32_t begin, std::uint32_t size) const
    {
        return {reinterpret_cast<const char*>(at(begin, size)), size};
    }
    void store(std::uint32_t place, std::uint32_t number) const
    {
        std::memcpy(at(place, sizeof number), &number, sizeof number);
    }
    [[nodiscard]] std::uint32_t load(std::uint32_t place) const
    {
        std::uint32_t number = 0;
        std::memcpy(&number, at(place, sizeof number), sizeof number);
        return number;
    }

    /// Copies bytes into the memory, where the C frees them.
    std::uint32_t put(const void* bytes, std::size_t size) const
    {
        const std::uint32_t place = Z_index_bgZ___wbindgen_malloc(module, static_cast<std::uint32_t>(size), 1);
        std::memcpy(at(place, size), bytes, size);
        return place;
    }
};

extern "C" {

uint32_t wasm_rt_call_stack_depth = 0;
volatile uint32_t droplet_resvg_max_depth = droplet::kMaxDepth;

void wasm_rt_trap(wasm_rt_trap_t trap)
{
    using droplet::ResvgError;
    if (trap == WASM_RT_TRAP_EXHAUSTION) {
        const bool is_late = droplet_resvg_max_depth == 0;
        throw ResvgError(is_late ? ResvgError::Cause::Time : ResvgError::Cause::Depth, "");
    }
    // Where memory is refused, Rust's libraries end by an unreachable instruction.
    throw ResvgError(ResvgError::Cause::Other, "resvg has failed");
}

/// Numbers for types of functions: equal types have one.
uint32_t wasm_rt_register_func_type(uint32_t params, uint32_t results, ...)
{
    static std::vector<std::vector<int>> types;
    std::vector<int> type{static_cast<int>(params)};
    va_list more;
    va_start(more, results);
    for (uint32_t i = 0; i < params + results; ++i) {
        type.push_back(va_arg(more, int));
    }
    va_end(more);
    const auto found = std::find(types.begin(), types.end(), type);
    if (found != types.end()) {
        return static_cast<uint32_t>(found - types.begin()) + 1;
    }
    types.push_back(std::move(type));
    return static_cast<uint32_t>(types.size());
}

void wasm_rt_allocate_memory(wasm_rt_memory_t* memory, uint32_t initial_pages, uint32_t max_pages)
{
    memory->pages = initial_pages;
    memory->max_pages = std::min<uint32_t>(
        max_pages, static_cast<uint32_t>(std::min<std::size_t>(droplet::memory_limit / droplet::kPage, 65535)));
    memory->size = initial_pages * droplet::kPage;
    memory->data = static_cast<uint8_t*>(std::calloc(memory->size, 1));
    if (memory->data == nullptr) {
        throw std::bad_alloc();
    }
}

uint32_t wasm_rt_grow_memory(wasm_rt_memory_t* memory, uint32_t pages)
{
    const uint32_t before = memory->pages;
    if (pages > memory->max_pages - std::min(before, memory->max_pages)) {
        throw droplet::ResvgError(droplet::ResvgError::Cause::Memory, "");
    }
    const std::size_t size = std::size_t{before + pages} * droplet::kPage;
    auto* const data = static_cast<uint8_t*>(std::realloc(memory->data, size));
    if (data == nullptr) {
        throw std::bad_alloc();
    }
    std::memset(data + memory->size, 0, size - memory->size);
    memory->data = data;
    memory->pages = before + pages;
    memory->size = static_cast<uint32_t>(size);
    return before;
}

void wasm_rt_free_memory(wasm_rt_memory_t* memory)
{
    std::free(memory->data);
}

void wasm_rt_allocate_funcref_table(wasm_rt_funcref_table_t* table, uint32_t elements, uint32_t max_elements)
{
    table->size = elements;
    table->max_size = max_elements;
    table->data = static_cast<wasm_rt_funcref_t*>(std::calloc(elements, sizeof(wasm_rt_funcref_t)));
    if (table->data == nullptr) {
        throw std::bad_alloc();
    }
}

void wasm_rt_free_funcref_table(wasm_rt_funcref_table_t* table)
{
    std::free(table->data);
}

bool wasm_rt_is_initialized(void)
{
    return true;
}

u32 Z_wbgZ___wbg_new_28c511d9baebfa89(Z_wbg_instance_t* wbg, u32 begin, u32 size)  // new Error(text)
{
    return wbg->add(wbg->text(begin, size));
}

u32 Z_wbgZ___wbindgen_memory(Z_wbg_instance_t* wbg)
{
    return wbg->add(droplet::Buffer{});
}

u32 Z_wbgZ___wbg_buffer_12d079cc21e14bdb(Z_wbg_instance_t* wbg, u32)
{
    return wbg->add(droplet::Buffer{});
}

u32 Z_wbgZ___wbg_newwithbyteoffsetandlength_aa4a17c33a06e5cb(Z_wbg_instance_t* wbg, u32, u32 begin, u32 size)
{
    return wbg->add(droplet::View{begin, size});
}

/// Values are few, and live as long as a drawing.
void Z_wbgZ___wbindgen_object_drop_ref(Z_wbg_instance_t*, u32) {}

u32 Z_wbgZ___wbg_new_63b92bc8671ed464(Z_wbg_instance_t* wbg, u32 from)  // new Uint8Array(of what)
{
    if (const auto* view = wbg->find<droplet::View>(from)) {
        const uint8_t* const bytes = wbg->at(view->begin, view->size);
        return wbg->add(droplet::Bytes(bytes, bytes + view->size));
    }
    return wbg->add(droplet::View{0, wbg->module->w2c_memory.size});
}

u32 Z_wbgZ___wbg_values_839f3396d5aac002(Z_wbg_instance_t* wbg, u32 list)
{
    const auto* const items = wbg->find<droplet::List>(list);
    return wbg->add(droplet::Iterator{items != nullptr ? *items : droplet::List{}, 0});
}

u32 Z_wbgZ___wbg_next_196c84450b364254(Z_wbg_instance_t* wbg, u32 iterator)
{
    // What it gives is a list of the item; an empty one is the end.
    auto& at = std::get<droplet::Iterator>(wbg->values[iterator - Z_wbg_instance_t::kFirst]);
    return wbg->add(at.next < at.items.size() ? droplet::List{at.items[at.next++]} : droplet::List{});
}

u32 Z_wbgZ___wbg_done_298b57d23c0fc80c(Z_wbg_instance_t* wbg, u32 given)
{
    return wbg->find<droplet::List>(given)->empty() ? 1 : 0;
}

u32 Z_wbgZ___wbg_value_d93c65011f51a456(Z_wbg_instance_t* wbg, u32 given)
{
    return wbg->find<droplet::List>(given)->front();
}

u32 Z_wbgZ___wbg_instanceof_Uint8Array_2b3bbecd033d19f6(Z_wbg_instance_t* wbg, u32 value)
{
    return wbg->find<droplet::Bytes>(value) != nullptr ? 1 : 0;
}

void Z_wbgZ___wbindgen_string_get(Z_wbg_instance_t* wbg, u32 place, u32 value)
{
    const auto* const text = wbg->find<std::string>(value);
    wbg->store(place + 4, text != nullptr ? static_cast<u32>(text->size()) : 0);
    wbg->store(place, text != nullptr ? wbg->put(text->data(), text->size()) : 0);
}

u32 Z_wbgZ___wbg_new_16b304a2cfa7ff4a(Z_wbg_instance_t* wbg)  // new Array()
{
    return wbg->add(droplet::List{});
}

u32 Z_wbgZ___wbindgen_string_new(Z_wbg_instance_t* wbg, u32 begin, u32 size)
{
    return wbg->add(wbg->text(begin, size));
}

u32 Z_wbgZ___wbg_push_a5b05aedc7234f9f(Z_wbg_instance_t* wbg, u32 list, u32 value)
{
    auto& items = std::get<droplet::List>(wbg->values[list - Z_wbg_instance_t::kFirst]);
    items.push_back(value);
    return static_cast<u32>(items.size());
}

u32 Z_wbgZ___wbg_length_c20a40f15020d68a(Z_wbg_instance_t* wbg, u32 bytes)
{
    return static_cast<u32>(wbg->find<droplet::Bytes>(bytes)->size());
}

void Z_wbgZ___wbg_set_a47bac70306a19a7(Z_wbg_instance_t* wbg, u32, u32 from, u32 place)  // into the whole memory
{
    const auto& bytes = *wbg->find<droplet::Bytes>(from);
    std::copy(bytes.begin(), bytes.end(), wbg->at(place, bytes.size()));
}

void Z_wbgZ___wbindgen_throw(Z_wbg_instance_t* wbg, u32 begin, u32 size)
{
    throw droplet::ResvgError(droplet::ResvgError::Cause::Other, wbg->text(begin, size));
}

}  // extern "C"

// NOLINTEND(readability-identifier-naming,cppcoreguidelines-avoid-non-const-global-variables)

namespace droplet {
namespace {

/// Ends a drawing when its time is over.
class Watchdog {
public:
    explicit Watchdog(double seconds)
        : thread_([this, seconds] {
              std::unique_lock lock(mutex_);
              if (!has_ended_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return ended_; })) {
                  droplet_resvg_max_depth = 0;
              }
          })
    {
    }
    ~Watchdog()
    {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        has_ended_.notify_one();
        thread_.join();
        droplet_resvg_max_depth = kMaxDepth;
    }
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

private:
    std::mutex mutex_;
    std::condition_variable has_ended_;
    bool ended_ = false;
    std::thread thread_;
};

/// Runs a function on a stack that is deep enough for drawings.
void onDeepStack(const std::function<void()>& run)
{
    struct Task {
        const std::function<void()>& run;
        std::exception_ptr error;
    } task{run, {}};
    const auto thread = ::_beginthreadex(
        nullptr, kStack,
        [](void* argument) -> unsigned {
            auto& given = *static_cast<Task*>(argument);
            try {
                given.run();
            } catch (...) {
                given.error = std::current_exception();
            }
            return 0;
        },
        &task, STACK_SIZE_PARAM_IS_A_RESERVATION, nullptr);
    if (thread == 0) {
        throw std::bad_alloc();
    }
    ::WaitForSingleObject(reinterpret_cast<HANDLE>(thread), INFINITE);
    ::CloseHandle(reinterpret_cast<HANDLE>(thread));
    if (task.error) {
        std::rethrow_exception(task.error);
    }
}

}  // namespace

struct Resvg::Module {
    explicit Module(const ResvgLimits& limits) : lock(one_at_a_time), watchdog(limits.seconds)
    {
        static const bool is_known = [] {
            Z_index_bg_init_module();
            return true;
        }();
        static_cast<void>(is_known);
        memory_limit = limits.memory;
        wasm_rt_call_stack_depth = 0;
        Z_index_bg_instantiate(&module, &wbg);
        wbg.module = &module;
    }
    ~Module() { Z_index_bg_free(&module); }
    Module(const Module&) = delete;
    Module& operator=(const Module&) = delete;

    /// Calls `take` with the parsed drawing.
    void open(const std::string& svg, const ResvgFonts& fonts, const std::string& options,
              const std::function<void(std::uint32_t)>& take)
    {
        onDeepStack([&] {
            List files;
            for (const Bytes& file : fonts.files) {
                files.push_back(wbg.add(file));
            }
            const std::uint32_t results =
                Z_index_bgZ___wbindgen_add_to_stack_pointer(&module, static_cast<std::uint32_t>(-16));
            const std::uint32_t option_place = wbg.put(options.data(), options.size());
            Z_index_bgZ_resvg_new(&module, results, wbg.add(svg), option_place,
                                  static_cast<std::uint32_t>(options.size()), fonts.files.empty() ? 0 : wbg.add(files));
            const std::uint32_t drawing = checked(results, Cause::Damaged);
            take(drawing);
            Z_index_bgZ___wbg_resvg_free(&module, drawing);
            Z_index_bgZ___wbindgen_add_to_stack_pointer(&module, 16);
        });
    }

    /// First of three results: the value, an error, and whether there was one.
    std::uint32_t checked(std::uint32_t results, Cause cause) const
    {
        if (wbg.load(results + 8) != 0) {
            const auto* const why = wbg.find<std::string>(wbg.load(results + 4));
            throw ResvgError(cause, why != nullptr ? *why : "unknown error");
        }
        return wbg.load(results);
    }

    std::unique_lock<std::mutex> lock;
    Watchdog watchdog;
    Z_wbg_instance_t wbg;
    Z_index_bg_instance_t module{};
};

Resvg::Resvg(const ResvgLimits& limits) : module_(new Module(limits)) {}

Resvg::~Resvg() = default;

Resvg::Box Resvg::page(const std::string& svg, const ResvgFonts& fonts)
{
    Box box;
    module_->open(svg, fonts, R"({"font":)" + fonts.names + "}", [&](std::uint32_t drawing) {
        box.width = static_cast<double>(Z_index_bgZ_resvg_width(&module_->module, drawing));
        box.height = static_cast<double>(Z_index_bgZ_resvg_height(&module_->module, drawing));
    });
    return box;
}

std::optional<Resvg::Box> Resvg::ink(const std::string& svg, const ResvgFonts& fonts)
{
    std::optional<Box> ink;
    module_->open(svg, fonts, R"({"font":)" + fonts.names + "}", [&](std::uint32_t drawing) {
        Z_index_bg_instance_t* const module = &module_->module;
        if (const std::uint32_t box = Z_index_bgZ_resvg_getBBox(module, drawing); box != 0) {
            ink = Box{Z_index_bgZ___wbg_get_bbox_x(module, box), Z_index_bgZ___wbg_get_bbox_y(module, box),
                      Z_index_bgZ___wbg_get_bbox_width(module, box), Z_index_bgZ___wbg_get_bbox_height(module, box)};
        }
    });
    return ink;
}

std::vector<std::uint8_t> Resvg::pixels(const std::string& svg, const ResvgFonts& fonts, int width)
{
    std::vector<std::uint8_t> pixels;
    const std::string fit = R"("fitTo":{"mode":"width","value":)" + std::to_string(width) + "}";
    module_->open(svg, fonts, R"({"font":)" + fonts.names + "," + fit + "}", [&](std::uint32_t drawing) {
        Z_index_bg_instance_t* const module = &module_->module;
        const std::uint32_t results =
            Z_index_bgZ___wbindgen_add_to_stack_pointer(module, static_cast<std::uint32_t>(-16));
        Z_index_bgZ_resvg_render(module, results, drawing);
        const std::uint32_t image = module_->checked(results, Cause::Other);
        if (const auto* bytes = module_->wbg.find<Bytes>(Z_index_bgZ_renderedimage_pixels(module, image))) {
            pixels = *bytes;
        }
    });
    return pixels;
}

}  // namespace droplet
