#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A Slurm cluster of this one machine, to try a workflow on: slurm_node.sh start | stop. As root, with
# Debian's slurm-wlm. All of it is in one folder (RIDGELINE_SLURM, default /tmp/ridgeline_slurm); after
# `start` say `export SLURM_CONF=/tmp/ridgeline_slurm/slurm.conf`.
set -eu
folder=${RIDGELINE_SLURM:-/tmp/ridgeline_slurm}
export SLURM_CONF="$folder/slurm.conf"

start() {
  mkdir -p "$folder/state" "$folder/spool" "$folder/munge"
  chmod 0711 "$folder"
  node=$(hostname -s)
  # A key and a socket of its own: no other munge of the machine is touched.
  [ -f "$folder/munge/key" ] || dd if=/dev/urandom of="$folder/munge/key" bs=1 count=1024 2>/dev/null
  chmod 0400 "$folder/munge/key"
  cat > "$SLURM_CONF" <<END
ClusterName=ridgeline
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=5
MpiDefault=none
ReturnToService=2
MinJobAge=600
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(awk '/MemTotal/ {print int($2 / 1024 * 0.9)}' /proc/meminfo) State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP
END
  munged --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" --seed-file="$folder/munge/seed"
  slurmctld
  slurmd -N "$node"
  for _ in 1 2 3 4 5 6 7 8 9 10; do
    sinfo --noheader --format=%t 2>/dev/null | grep -q idle && break
    sleep 1
  done
  sinfo
}

stop() {
  for pid in "$folder/slurmd.pid" "$folder/slurmctld.pid" "$folder/munge/pid"; do
    [ -f "$pid" ] && kill "$(cat "$pid")" 2>/dev/null || true
  done
}

case ${1:-} in
  start | stop) "$1" ;;
  *) echo "usage: slurm_node.sh start | stop" >&2; exit 2 ;;
esac
