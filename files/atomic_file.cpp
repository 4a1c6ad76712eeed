// SPDX-License-Identifier: Apache-2.0
#include "files/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <random>
#include <tuple>
#include <utility>

#include "files/own_file.hpp"
#include "files/temporary_names.hpp"
#include "files/text_file.hpp"

namespace files {
namespace {

namespace fs = std::filesystem;

/// Repeats a call until no signal interrupts it. Returns 0 or errno.
template <class Call>
int persistently(Call call) {
  for (;;) {
    if (call() == 0) return 0;
    if (errno != EINTR) return errno;
  }
}

/// Writes the whole text, in several calls if necessary. Returns 0 or errno. A write to a pipe may wait for
/// its reader; a termination signal ends the wait.
int write_all(int descriptor, std::string_view text, bool waits) {
  while (!text.empty()) {
    const ssize_t taken = ::write(descriptor, text.data(), text.size());
    if (taken >= 0) {
      text.remove_prefix(static_cast<std::size_t>(taken));
    } else if (errno == EAGAIN && waits) {
      pollfd ready{descriptor, POLLOUT, 0};
      if (::poll(&ready, 1, -1) < 0) return errno;
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

/// The file at the end of a chain of links, whether the file exists or not; if the links form a circle, the
/// last visited link.
fs::path end_of_links(fs::path path) {
  constexpr int most_links = 40;  // the kernel's limit
  std::error_code none;
  for (int n = 0; n < most_links && fs::is_symlink(path, none); ++n)
    path = path.parent_path() / fs::read_symlink(path, none);
  return path;
}

/// A name that no other program uses, and that no killed program has left in the folder.
std::string random_name() {
  std::random_device random;
  return fmt::format(".sixstep-{:08x}{:08x}.tmp", random(), random());
}

/// Reasons why a file at this path is refused although the folder is writable. `partial`: name of the file
/// for an interrupted run.
base::Problems refused(const Destination& to, const std::string& partial) {
  if (ReadLog::has(to.path))
    return {{.where = to.path + ":",
             .limit = "is an input of this command, which the output would replace",
             .cure = "name another file"}};
  for (const std::string& path : {to.path, partial})
    if (!to.force && is_foreign(path))
      return {{.where = path + ":",
               .limit = "was not written by sixstep, or was changed after sixstep wrote it",
               .cure = "name another file, or add --force to replace it"}};
  struct stat unused {};
  if (::lstat(partial.c_str(), &unused) != 0 && errno == ENAMETOOLONG)
    return {unwritable(to.path, ENAMETOOLONG)};
  return {};
}

/// Synchronises a folder: only then is a file's new name on the disk.
void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

base::Problem unwritable(const std::string& path, int reason) {
  const char* cure = "check that the folder exists and can be written, and that the disk has free space";
  if (reason == EISDIR) cure = "name a file in this folder";
  if (reason == ENAMETOOLONG) cure = "choose a shorter name: an interrupted run adds .partial to it";
  if (reason == ELOOP) cure = "name the file itself, not a link that points to itself";
  return {
      .where = path + ":", .limit = std::string("cannot be written: ") + std::strerror(reason), .cure = cure};
}

std::string saved_instead(const std::string& path) {
  return fmt::format("the finished part is in {}; free disk space and run again", partial_name(path));
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
  forget_temporary(name->c_str());
  delete name;
}

/// Opens a device or pipe directly. The call may wait for the pipe's other end. Writes do not block in the
/// kernel, because a signal just before a blocking write would be lost.
int AtomicFile::open_device() {
  waits_ = true;
  const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor >= 0) ::fcntl(descriptor, F_SETFL, O_NONBLOCK);
  return descriptor;
}

/// Opens a unique name in the folder of the final file. `old` is the file to be replaced. The new file never
/// has more permissions than the old file, not even for a moment.
int AtomicFile::open_beside(const struct stat* old) {
  constexpr mode_t usual = 0666, permission_bits = 0777;
  const mode_t permissions = old ? old->st_mode & permission_bits : usual;
  int descriptor = -1;
  do {
    const std::string name = (folder_ / random_name()).string();
    descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, permissions);
    if (descriptor >= 0) temporary_.reset(new std::string(name));
  } while (descriptor < 0 && errno == EEXIST);
  if (temporary_) note_temporary(temporary_->c_str());
  if (descriptor >= 0 && old) {
    std::ignore = ::fchown(descriptor, old->st_uid, old->st_gid);  // succeeds only for root, because only
                                                                   // root may give a file to another user
    ::fchmod(descriptor, permissions);  // the umask may have removed some permissions
  }
  return descriptor;
}

base::Result<AtomicFile> AtomicFile::create(const Destination& to) {
  if (to.path == "-")  // only the caller knows which text may go to standard output
    return base::Problem{.where = "-",
                         .limit = "means standard output, but this output must be a file",
                         .cure = "name a file; for a file with the name - write ./-"};
  AtomicFile file;
  file.path_ = to.path;
  struct stat there {};
  const bool exists = ::stat(to.path.c_str(), &there) == 0;
  if (!exists && errno != ENOENT) return unwritable(to.path, errno);
  if (exists && S_ISDIR(there.st_mode)) return unwritable(to.path, EISDIR);
  if (exists && S_ISBLK(there.st_mode))
    return base::Problem{
        .where = to.path + ":", .limit = "is a disk device, not a file", .cure = "name a file on this disk"};
  int descriptor = -1;
  if (exists && !S_ISREG(there.st_mode)) {
    descriptor = file.open_device();
  } else {
    file.path_ = end_of_links(to.path).string();
    // The path is made absolute now, because foreign code in a run may change the working folder.
    std::error_code unknown;
    const fs::path here = fs::path(file.path_).parent_path();
    file.folder_ = fs::absolute(here.empty() ? "." : here, unknown);
    if (unknown) file.folder_ = here;
    if (base::Problems found = refused(to, partial_name(file.path_)); !found.empty()) return found;
    if (exists && ::access(to.path.c_str(), W_OK) != 0) return unwritable(to.path, errno);
    descriptor = file.open_beside(exists ? &there : nullptr);
  }
  if (descriptor < 0) return unwritable(to.path, errno);
  file.descriptor_.reset(new int(descriptor));
  return file;
}

void AtomicFile::write(std::string_view text) {
  if (error_ != 0 || !descriptor_) return;
  error_ = write_all(*descriptor_, text, waits_);
  if (error_ == 0) size_ += text.size();
}

void AtomicFile::begin_again() {
  if ((size_ == 0 && error_ == 0) || !temporary_ || !descriptor_) return;
  error_ = ::lseek(*descriptor_, 0, SEEK_SET) == 0 ? 0 : errno;
  size_ = 0;
}

int AtomicFile::reserve(std::uint64_t bytes) {
  if (!temporary_ || !descriptor_) return 0;
  int failed = EINTR;
  while (failed == EINTR) failed = ::posix_fallocate(*descriptor_, 0, static_cast<off_t>(bytes));
  return failed;
}

bool AtomicFile::reader_is_gone() const { return error_ == EPIPE || error_ == EINTR; }

base::Problems AtomicFile::commit_partial() { return commit_as(temporary_ ? partial_name(path_) : path_); }

base::Problems AtomicFile::commit_as(const std::string& path) {
  if (!descriptor_) return {};
  if (error_ != 0) return save_what_is_whole();
  error_ = put_in_place(path);
  descriptor_.reset();
  if (error_ != 0) return {unwritable(path, error_)};
  if (temporary_) {
    temporary_->clear();
    sync_folder(folder_);
  }
  return {};
}

base::Problems AtomicFile::save_what_is_whole() {
  if (reader_is_gone()) return {};
  base::Problem problem = unwritable(path_, error_);
  if (!temporary_ || size_ == 0) return {problem};
  error_ = 0;
  if (commit_partial().empty()) problem.cure = saved_instead(path_);
  return {problem};
}

/// Writes the file to the disk first, then renames it. Returns 0 or errno.
int AtomicFile::put_in_place(const std::string& path) {
  if (!temporary_) return 0;
  const int descriptor = *descriptor_;
  // Removes the bytes of a failed write, and reserved space, after the completely written text.
  if (const int failed = persistently([&] { return ::ftruncate(descriptor, static_cast<off_t>(size_)); }))
    return failed;
  if (const int failed = persistently([&] { return ::fsync(descriptor); })) return failed;
  const fs::path whole = folder_ / fs::path(path).filename();
  return std::rename(temporary_->c_str(), whole.c_str()) == 0 ? 0 : errno;
}

}  // namespace files
