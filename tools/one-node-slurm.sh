#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# A Slurm of one node, this machine, to try `tripoint suite emit --for slurm` and the kit of `tripoint predict` with: the test
# `schedulers` sends a suite to it while it runs. Needs root, and Debian's slurmctld, slurmd, slurm-client and munge, which it installs.
#   tools/one-node-slurm.sh start | stop
# It takes the place of /etc/slurm/slurm.conf, and refuses to where there is one that it has not written.
set -euo pipefail
conf=/etc/slurm/slurm.conf
mark="# Written by tools/one-node-slurm.sh"
host=$(hostname -s)

stop() {
  pkill -x slurmd || true
  pkill -x slurmctld || true
  pkill -x munged || true
}

start() {
  command -v slurmctld slurmd sbatch munged > /dev/null || apt-get install -y --no-install-recommends slurmctld slurmd slurm-client munge
  if [ -e "$conf" ] && ! grep -qF "$mark" "$conf"; then
    echo "$0: $conf is there already: this machine has a Slurm of its own" >&2
    exit 2
  fi
  mkdir -p /etc/slurm /var/spool/slurmctld /var/spool/slurmd /var/log/slurm /run/munge
  chown munge: /run/munge
  cat > "$conf" << END
$mark
ClusterName=one
SlurmctldHost=$host
SlurmUser=root
AuthType=auth/munge
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdSpoolDir=/var/spool/slurmd
StateSaveLocation=/var/spool/slurmctld
SlurmctldPidFile=/run/slurmctld.pid
SlurmdPidFile=/run/slurmd.pid
SlurmctldLogFile=/var/log/slurm/slurmctld.log
SlurmdLogFile=/var/log/slurm/slurmd.log
ReturnToService=2
NodeName=$host CPUs=$(nproc) State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
END
  pgrep -x munged > /dev/null || runuser -u munge -- munged
  pgrep -x slurmctld > /dev/null || slurmctld
  pgrep -x slurmd > /dev/null || slurmd
  for _ in $(seq 30); do
    if [ "$(sinfo --noheader --format=%t)" = idle ]; then exit 0; fi
    sleep 1
  done
  echo "$0: the node is not idle after 30 s: see /var/log/slurm" >&2
  exit 1
}

case "${1:-}" in
  start) start ;;
  stop) stop ;;
  *)
    echo "usage: $0 start | stop" >&2
    exit 2
    ;;
esac
