// SPDX-License-Identifier: GPL-3.0-or-later
#include "film.h"

#include <exception>
#include <utility>

namespace cli {

Film::Film(std::optional<std::size_t> frames, const droplet::OutputOptions& treatment, ProgressDisplay& progress,
           std::optional<ResumableRun> resumable)
    : frames_(frames), treatment_(treatment), progress_(progress)
{
    if (resumable) {
        checkpoint_.emplace(*std::move(resumable), treatment);
    }
}

std::optional<Checkpoint> Film::begin(bool resume)
{
    std::optional<Checkpoint> checkpoint = checkpoint_ ? checkpoint_->begin(resume) : std::nullopt;
    written_ = checkpoint ? checkpoint->frames : 0;
    return checkpoint;
}

bool Film::isWritten(std::size_t number) const
{
    return number <= written_ && checkpoint_->run().hasFrame(number);
}

void Film::make(std::size_t done, const FilmSteps& steps)
{
    for (std::size_t number = done + 1; !frames_ || number <= *frames_; ++number) {
        std::optional<std::function<void()>> draw = steps.frame(number);
        if (!draw) {
            break;
        }
        add(number, *std::move(draw), steps.state);
    }
    drawing_.wait();
}

void Film::add(std::size_t number, std::function<void()> draw, const std::function<Blobs()>& state)
{
    drawing_.wait();
    drawing_.run([this, number, draw = std::move(draw)] {
        draw();
        if (frames_) {
            progress_.reportFrame(number, *frames_);
        }
    });
    if (checkpoint_ && number > written_ && checkpoint_->isDue(number)) {
        drawing_.wait();
        saving_.wait();
        checkpoint_->write({number, state ? state() : Blobs{}});
    }
}

void Film::save(std::vector<OutputFile> files)
{
    saving_.wait();
    saving_.run([files = std::move(files), this] { writeTogether(files, treatment_); });
}

void Film::beginArchive(std::ostream& out)
{
    archive_.emplace(out, droplet::ZipOptions{.deflates = true, .zip64 = true});
}

void Film::pack(std::vector<OutputFile> files)
{
    saving_.wait();
    saving_.run([files = std::move(files), this] {
        for (const OutputFile& file : files) {
            archive_->add({file.path, file.write});
        }
    });
}

void Film::write(const std::optional<std::string>& table, const std::function<void(std::ostream*)>& make,
                 std::vector<OutputFile> files)
{
    const auto made = [&](std::ostream* out) {
        try {
            make(out);
            drawing_.wait();
            saving_.wait();
            if (archive_) {
                archive_bytes_ = archive_->finish();
            }
        } catch (...) {
            settle();
            throw;
        }
    };
    if (table) {
        files.insert(files.begin(), {*table, [&](std::ostream& out) { made(&out); }});
    } else {
        made(nullptr);
    }
    writeTogether(files, treatment_);
    if (checkpoint_) {
        checkpoint_->end();
    }
}

void Film::settle()
{
    for (tbb::task_group* group : {&drawing_, &saving_}) {
        try {
            group->wait();
        } catch (const std::exception&) {
            // The first error counts.
        }
    }
}

}  // namespace cli
