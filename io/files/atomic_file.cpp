// SPDX-License-Identifier: Apache-2.0
#include "io/files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "io/files/text_file.hpp"

namespace io {
namespace {

namespace fs = std::filesystem;

/// As much as the kernel takes, until all is written; 0, or what errno says.
int write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t taken = ::write(descriptor, text.data(), text.size());
    if (taken >= 0)
      text.remove_prefix(static_cast<std::size_t>(taken));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

/// The name is safe on the disk only once its folder is.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

base::Problem unwritable(const std::string& path, int reason) {
  return {.where = path + ":",
          .limit = std::string("cannot be written: ") + std::strerror(reason),
          .cure = reason == EISDIR
                      ? "name a file in it"
                      : "check that the folder exists and may be written, and that the disk has room"};
}

std::string saved_instead(const std::string& path) {
  return fmt::format("what was finished is in {}; make room and run it again", partial_name(path));
}

std::string partial_name(const std::string& path) {
  fs::path name(path);
  const std::string extension = name.extension().string();
  return name.replace_extension(fmt::format(".partial{}", extension)).string();
}

void AtomicFile::Close::operator()(int* descriptor) const {
  ::close(*descriptor);
  delete descriptor;
}

void AtomicFile::Remove::operator()(std::string* name) const {
  if (!name->empty()) ::unlink(name->c_str());
  delete name;
}

base::Result<AtomicFile> AtomicFile::create(const std::string& path) {
  static std::atomic<int> count{0};
  AtomicFile file;
  file.path_ = path;
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) return unwritable(path, EISDIR);
  if (exists && S_ISREG(status.st_mode) && ReadLog::has(path))
    return base::Problem{.where = path + ":",
                         .limit = "is read here: what is written would take its place",
                         .cure = "name another file"};
  int descriptor = -1;
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    std::error_code ignored;
    // A link keeps its place: what it names is replaced.
    if (exists) file.path_ = fs::canonical(path, ignored).string();
    if (exists && ::access(path.c_str(), W_OK) != 0) return unwritable(path, errno);
    const fs::path target(file.path_);
    const std::string hidden = fmt::format(".{}.tmp{}-{}", target.filename().string(), ::getpid(), count++);
    const fs::path name = target.parent_path() / hidden;
    descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) file.temporary_.reset(new std::string(name.string()));
  }
  if (descriptor < 0) return unwritable(path, errno);
  file.descriptor_.reset(new int(descriptor));
  return file;
}

void AtomicFile::write(std::string_view text) {
  if (error_ != 0 || !descriptor_) return;
  error_ = write_all(*descriptor_, text);
  if (error_ == 0) size_ += text.size();
}

int AtomicFile::reserve(std::uint64_t bytes) {
  return temporary_ && descriptor_ ? ::posix_fallocate(*descriptor_, 0, static_cast<off_t>(bytes)) : 0;
}

base::Problems AtomicFile::commit_partial() { return commit_as(temporary_ ? partial_name(path_) : path_); }

base::Problems AtomicFile::commit_as(const std::string& path) {
  if (!descriptor_) return {};
  if (error_ != 0) return save_what_is_whole();
  error_ = put_in_place(path);
  descriptor_.reset();
  if (error_ != 0) return {unwritable(path, error_)};
  if (temporary_) {
    temporary_->clear();
    sync_folder(fs::path(path).parent_path());
  }
  return {};
}

base::Problems AtomicFile::save_what_is_whole() {
  // The reader of a pipe has seen enough: nobody is to blame.
  if (error_ == EPIPE) return {};
  base::Problem problem = unwritable(path_, error_);
  if (!temporary_ || size_ == 0) return {problem};
  error_ = 0;
  if (commit_partial().empty()) problem.cure = saved_instead(path_);
  return {problem};
}

/// Safely on the disk first, then under its name. 0, or what errno says.
int AtomicFile::put_in_place(const std::string& path) {
  if (!temporary_) return 0;
  // Beyond what was written whole there may be a piece that failed, or room that was only reserved.
  if (!elsewhere_ && ::ftruncate(*descriptor_, static_cast<off_t>(size_)) != 0) return errno;
  if (::fsync(*descriptor_) != 0 || std::rename(temporary_->c_str(), path.c_str()) != 0) return errno;
  return 0;
}

}  // namespace io
