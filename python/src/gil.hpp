// SPDX-License-Identifier: BSD-3-Clause
// The lock of the interpreter, given away while the library works and taken to call back. Where the interpreter ends while threads still work
// (daemons), it ends each that asks for the lock by unwinding its stack, and the library's noexcept would abort the process: from
// then on such threads wait for ever.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

namespace gyrostat::python {

/// Who is about to take the lock or holds it, and whether the interpreter still gives it.
class Lock {
 public:
  static void enter() noexcept {
    ++inside_;
    if (!closed_ || std::this_thread::get_id() == closer_) return;
    --inside_;
    for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
  }
  static void leave() noexcept { --inside_; }

  /// Lets nobody in any more but the calling thread, which holds the lock, and waits until those who are inside have left, ten seconds at most.
  static void close() noexcept {
    closer_ = std::this_thread::get_id();
    closed_ = true;
    const pybind11::gil_scoped_release free;
    for (int i = 0; i < 2000 && inside_ > 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  /// In the child of a fork, which has none of the other threads.
  static void forget() noexcept { inside_ = 0; }

 private:
  inline static std::atomic<int> inside_{0};
  inline static std::atomic<bool> closed_{false};
  inline static std::atomic<std::thread::id> closer_{};
};

/// The lock is given away for the life of this object.
class Unlocked {
 public:
  Unlocked() : free_(std::in_place) {}
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;
  ~Unlocked() {
    Lock::enter();
    free_.reset();
    Lock::leave();
  }

 private:
  std::optional<pybind11::gil_scoped_release> free_;
};

/// The lock is held for the life of this object.
class Locked {
  struct Inside {
    Inside() noexcept { Lock::enter(); }
    ~Inside() { Lock::leave(); }
  };

 public:
  Locked() = default;
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  Inside inside_;
  pybind11::gil_scoped_acquire hold_;
};

}  // namespace gyrostat::python
