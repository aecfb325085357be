// Outputs: whole or not at all, through links, never over what must stay.
#include "base/atomic_path.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <functional>
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

class AtomicPaths : public TestFolder {
 protected:
  void refused(const std::function<void()>& act, const fs::path& path, const std::string& reason) const {
    try {
      act();
      ADD_FAILURE() << "not refused: " << path;
    } catch (const OutputError& error) {
      EXPECT_EQ(std::string(error.what()).find(path.string() + ": cannot be written: "), 0u) << error.what();
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
  }
  std::set<fs::path> entries() const {
    std::set<fs::path> out;
    for (const auto& e : fs::recursive_directory_iterator(root_)) out.insert(e.path().lexically_relative(root_));
    return out;
  }
};

TEST_F(AtomicPaths, AFileIsWrittenWholeAndReplaced) {
  const std::string bytes("first\0line\r\n", 12);
  write_file(root_ / "a.txt", bytes);
  EXPECT_EQ(test::text_of(root_ / "a.txt"), bytes);
  write_file(root_ / "a.txt", "x");
  EXPECT_EQ(test::text_of(root_ / "a.txt"), "x");
  const std::string longest(255, 'n');  // the hidden name beside it must fit as well
  write_file(root_ / longest, "y");
  EXPECT_EQ(entries(), (std::set<fs::path>{"a.txt", longest}));
}

TEST_F(AtomicPaths, AReplacedFileKeepsItsPermissions) {
  write_file(root_ / "private", "old");
  fs::permissions(root_ / "private", fs::perms(0600));
  write_file(root_ / "private", "new");
  EXPECT_EQ(fs::status(root_ / "private").permissions(), fs::perms(0600));
  EXPECT_EQ(test::text_of(root_ / "private"), "new");
}

TEST_F(AtomicPaths, WithoutACommitNothingIsLeft) {
  {
    AtomicPath file(root_ / "file");
    file.write("text");
    AtomicPath folder(root_ / "a/b/folder");
    folder.make_folder();
    folder.write_inside("c/d", "text");
    EXPECT_FALSE(fs::exists(root_ / "file"));
    EXPECT_FALSE(fs::exists(root_ / "a/b/folder"));
  }
  EXPECT_TRUE(entries().empty());
  AtomicPath folder(root_ / "a/b/");
  folder.make_folder();
  folder.write_inside("c/d", "text");
  folder.commit();
  EXPECT_EQ(entries(), (std::set<fs::path>{"a", "a/b", "a/b/c", "a/b/c/d"}));
}

TEST_F(AtomicPaths, LinksAreWrittenThrough) {
  fs::create_directories(root_ / "far");
  fs::create_symlink("far", root_ / "near");
  fs::create_symlink("near/target", root_ / "link");  // to nothing yet, by another link
  fs::create_symlink(root_ / "link", root_ / "absolute");
  EXPECT_EQ(resolved(root_ / "absolute"), fs::canonical(root_) / "far/target");
  EXPECT_EQ(resolved(root_ / "near/../far/x"), fs::canonical(root_) / "far/x");
  EXPECT_EQ(resolved(root_ / "far/."), fs::canonical(root_) / "far");
  for (const char* text : {"one", "two"}) {
    write_file(root_ / "absolute", text);
    EXPECT_EQ(test::text_of(root_ / "far/target"), text);
  }
  EXPECT_TRUE(fs::is_symlink(root_ / "absolute") && fs::is_symlink(root_ / "link"));
  fs::create_symlink("loop", root_ / "loop");
  refused([&] { write_file(root_ / "loop", ""); }, root_ / "loop", "Too many levels");
}

TEST_F(AtomicPaths, FilesReplaceNoFolderNoDeviceAndNothingThatMayNotBeWritten) {
  fs::create_directories(root_ / "folder");
  write_file(root_ / "folder/years", "precious");
  ASSERT_EQ(::mkfifo((root_ / "pipe").c_str(), 0600), 0);
  for (const auto& act : {std::function<void(const fs::path&)>(require_writable_file),
                          std::function<void(const fs::path&)>([](const fs::path& p) { write_file(p, "text"); })}) {
    refused([&] { act(root_ / "folder"); }, root_ / "folder", "Is a directory");
    refused([&] { act(root_ / "folder/"); }, root_ / "folder/", "Is a directory");
    refused([&] { act(root_ / "new/"); }, root_ / "new/", "Is a directory");
    refused([&] { act(root_ / "pipe"); }, root_ / "pipe", "no regular file");
    refused([&] { act("/dev/full"); }, "/dev/full", "no regular file");
    refused([&] { act(root_ / "folder/years/a"); }, root_ / "folder/years/a", "Not a directory");
    refused([&] { act(root_ / "none/a"); }, root_ / "none/a", "No such file or directory");
    refused([&] { act(""); }, "", "the name is empty");
  }
  EXPECT_EQ(test::text_of(root_ / "folder/years"), "precious");
  EXPECT_EQ(entries(), (std::set<fs::path>{"folder", "folder/years", "pipe"}));
}

/// Permissions, which root has all of, so that it takes another user's place.
TEST_F(AtomicPaths, WithoutPermissionNothingIsWritten) {
  fs::create_directories(root_ / "locked");
  write_file(root_ / "locked/file", "old");
  fs::create_directories(root_ / "open");
  write_file(root_ / "open/file", "old");
  for (const char* path : {"locked", "locked/file", "open/file"}) {
    fs::permissions(root_ / path, fs::perms(path == std::string("locked") ? 0555 : 0444));
  }
  fs::permissions(root_ / "open", fs::perms(0777));
  const bool root = ::geteuid() == 0;
  if (root) {
    // access(2) asks for the real user.
    ASSERT_EQ(::setresuid(65534, 65534, 0), 0);
  }
  refused([&] { require_writable_file(root_ / "locked/new"); }, root_ / "locked/new", "Permission denied");
  refused([&] { require_writable_file(root_ / "locked/file"); }, root_ / "locked/file", "Permission denied");
  refused([&] { require_writable_file(root_ / "open/file"); }, root_ / "open/file", "Permission denied");
  refused([&] { write_file(root_ / "open/file", "new"); }, root_ / "open/file", "Permission denied");
  refused([&] { require_writable_folder(root_ / "locked/a/b", {}); }, root_ / "locked/a/b", "Permission denied");
  EXPECT_NO_THROW(require_writable_file(root_ / "open/new"));
  if (root) {
    ASSERT_EQ(::setresuid(0, 0, 0), 0);
  }
  EXPECT_EQ(test::text_of(root_ / "open/file"), "old");
  fs::permissions(root_ / "locked", fs::perms(0755));
}

TEST_F(AtomicPaths, FilesAppearAllOrNone) {
  write_file(root_ / "a", "old");
  const OutputFile bad[] = {{root_ / "a", "new"}, {root_ / "b", "new"}, {root_ / "none/c", "new"}};
  refused([&] { write_files(bad); }, root_ / "none/c", "No such file");
  EXPECT_EQ(test::text_of(root_ / "a"), "old");
  EXPECT_EQ(entries(), std::set<fs::path>{"a"});
  write_files(std::span(bad).first(2));
  EXPECT_EQ(test::text_of(root_ / "a") + test::text_of(root_ / "b"), "newnew");
}

TEST_F(AtomicPaths, AFolderIsReplacedOnlyWhereItHoldsNothingElse) {
  fs::create_directories(root_ / "it/sub");
  EXPECT_NO_THROW(require_writable_folder(root_ / "it", {})) << "empty, but for folders";
  write_file(root_ / "it/sub/a", "1");
  fs::create_symlink("nowhere", root_ / "it/b");
  EXPECT_NO_THROW(require_writable_folder(root_ / "it", {"sub/a", "b", "c"}));
  refused([&] { require_writable_folder(root_ / "it", {"sub/a"}); }, root_ / "it", "(b); it is left alone");
  refused([&] { require_writable_folder(root_ / "it", {"a", "b"}); }, root_ / "it", "(sub/a)");
  refused([&] { require_writable_folder(root_ / "it/sub/a", {}); }, root_ / "it/sub/a", "Not a directory");
  EXPECT_NO_THROW(require_writable_folder(root_ / "not/yet", {}));
  EXPECT_EQ(entries(), (std::set<fs::path>{"it", "it/sub", "it/sub/a", "it/b"}));
  AtomicPath over(root_ / "it");
  over.make_folder();
  over.write_inside("new", "2");
  over.commit();
  EXPECT_EQ(entries(), (std::set<fs::path>{"it", "it/new"}));
}

}  // namespace
}  // namespace plumbline
