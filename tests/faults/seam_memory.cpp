// SPDX-License-Identifier: BSD-3-Clause
// Calls for memory, and looks at the date.
#include <sys/mman.h>
#include <time.h>
#include <unwind.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "faults/seam.hpp"

extern "C" void* __libc_malloc(size_t);
extern "C" void* __libc_calloc(size_t, size_t);
extern "C" void* __libc_realloc(void*, size_t);
extern "C" void* __libc_memalign(size_t, size_t);

namespace fault_seam {
namespace {

/// Calls for memory. It asks for none itself.
struct Memory {
  std::atomic<int> state{0};  ///< 1: calls do not count, 2: they do
  std::atomic<long> calls{0};
  long at = 0;
  bool sticky = false;
  size_t callers = 0;  ///< that make a stack
};
Memory memory;

/// From where memory was asked for: its caller, and who called that one.
struct Stack {
  std::array<const void*, 128> frames;
  const void* caller;
  size_t depth = 0;
};

Stack stack_from(const void* caller) {
  Stack stack;
  stack.caller = caller;
  const auto add = [](_Unwind_Context* context, void* place) {
    auto* const to = static_cast<Stack*>(place);
    if (to->depth == std::min(to->frames.size(), memory.callers)) return _URC_END_OF_STACK;
    const auto* const at = reinterpret_cast<const void*>(_Unwind_GetIP(context));
    if (to->depth > 0 || at == to->caller) to->frames[to->depth++] = at;
    return _URC_NO_REASON;
  };
  _Unwind_Backtrace(add, &stack);
  return stack;
}

void mix(unsigned long& hash, unsigned long value) { hash = (hash ^ value) * 1099511628211UL; }

unsigned long hash_of(const Stack& stack) {
  unsigned long hash = 1469598103934665603UL;
  for (size_t n = 0; n < stack.depth; ++n) mix(hash, reinterpret_cast<unsigned long>(stack.frames[n]));
  return hash | 1UL;
}

/// The same in each run, wherever the system has put program and libraries.
unsigned long name_of(const Stack& stack) {
  unsigned long hash = 1469598103934665603UL;
  for (size_t n = 0; n < stack.depth; ++n) {
    Dl_info about{};
    const bool known = dladdr(stack.frames[n], &about) != 0 && about.dli_fname;
    for (const char* c = known ? about.dli_fname : ""; *c; ++c) mix(hash, static_cast<unsigned char>(*c));
    mix(hash, reinterpret_cast<unsigned long>(stack.frames[n]) -
                  reinterpret_cast<unsigned long>(known ? about.dli_fbase : nullptr));
  }
  return hash;
}

/// Stacks that were met, each with its first and its last call.
struct Met {
  unsigned long hash, name;
  long first, last;
};
constexpr size_t most_stacks = 1UL << 17;
Met* stacks_met = nullptr;
std::atomic_flag stacks_are_taken;

void meet(long now, const void* caller) {
  const Stack stack = stack_from(caller);
  const unsigned long hash = hash_of(stack);
  while (stacks_are_taken.test_and_set()) continue;
  size_t n = hash % most_stacks;
  for (size_t looks = 0; looks < most_stacks && stacks_met[n].hash != 0 && stacks_met[n].hash != hash;
       ++looks)
    n = (n + 1) % most_stacks;
  Met& met = stacks_met[n];
  if (met.hash == 0) met = {hash, name_of(stack), now, now};
  if (met.hash == hash) met.last = std::max(met.last, now);
  stacks_are_taken.clear();
}

/// A line to the log, where no memory may be asked for.
void note_line(const char* line, int size) {
  const char* log = said("FAULT_LOG");
  const int f =
      *log ? static_cast<int>(raw(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644))
           : -1;
  if (f < 0) return;
  raw(SYS_write, f, line, static_cast<size_t>(size));
  raw(SYS_close, f);
}

void begin_memory() {
  memory.state = 1;  // what is called here may ask for memory
  memory.at = std::atol(said("FAULT_AT"));
  memory.sticky = std::strstr(said("FAULT_KIND"), sticky_word);
  if (!is_about_memory() || !is_meant()) return;
  static_cast<void>(plan());
  memory.callers = static_cast<size_t>(std::atol(said("FAULT_STACKS")));
  if (memory.callers > 0 && memory.at == 0)
    stacks_met = static_cast<Met*>(
        mmap(nullptr, most_stacks * sizeof(Met), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  memory.state = 2;
}

/// Whether a call for memory from there gives none.
bool memory_is_out(const void* caller) {
  if (memory.state == 0) begin_memory();
  if (memory.state == 1) return false;
  const long now = ++memory.calls;
  if (stacks_met) meet(now, caller);
  if (memory.at == 0 || (now != memory.at && !(memory.sticky && now > memory.at))) return false;
  if (now == memory.at) {
    char line[64];
    note_line(line, std::snprintf(line, sizeof line, "%ld stack %016lx\n", now, name_of(stack_from(caller))));
  }
  errno = ENOMEM;
  return true;
}

/// Seconds by which the date is wrong at this look, up to ten years either way; 0 as long as it does not
/// jump.
time_t jump() {
  if (memory.state == 0 || !plan().jumps) return 0;
  plan().seed = static_cast<long>(static_cast<unsigned long>(plan().seed) * 6364136223846793005UL +
                                  1442695040888963407UL);
  return static_cast<time_t>(plan().seed >> 33) % 300000000;
}

/// What was counted, where nothing was to fail: the last line has the number of all calls.
[[gnu::destructor]] void tell_calls() {
  if (memory.state != 2 || memory.at != 0) return;
  memory.state = 1;
  char line[96];
  for (size_t n = 0; stacks_met && n < most_stacks; ++n)
    if (const Met& met = stacks_met[n]; met.hash != 0)
      note_line(line, std::snprintf(line, sizeof line, "%ld %ld %016lx\n", met.first, met.last, met.name));
  note_line(line, std::snprintf(line, sizeof line, "%ld memory\n", memory.calls.load()));
}

}  // namespace
}  // namespace fault_seam

using namespace fault_seam;

extern "C" {

/// Takes a new plan from the environment: for a program that forks a child a trial.
void fault_seam_begins() {
  made_plan() = new Plan;
  memory.state = 0;
  memory.calls = 0;
}

int clock_gettime(clockid_t clock, timespec* now) {
  NEXT(clock_gettime);
  const int result = next(clock, now);
  if (clock == CLOCK_REALTIME) now->tv_sec += jump();
  return result;
}

time_t time(time_t* place) {
  timespec now{};
  raw(SYS_clock_gettime, CLOCK_REALTIME, &now);
  now.tv_sec += jump();
  if (place) *place = now.tv_sec;
  return now.tv_sec;
}

void* malloc(size_t n) { return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_malloc(n); }
void* calloc(size_t n, size_t each) {
  return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_calloc(n, each);
}
void* realloc(void* old, size_t n) {
  return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_realloc(old, n);
}
void* memalign(size_t bound, size_t n) {
  return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_memalign(bound, n);
}
void* aligned_alloc(size_t bound, size_t n) {
  return memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_memalign(bound, n);
}

int posix_memalign(void** place, size_t bound, size_t n) {
  void* const made = memory_is_out(__builtin_return_address(0)) ? nullptr : __libc_memalign(bound, n);
  if (!made) return ENOMEM;
  *place = made;
  return 0;
}
}
