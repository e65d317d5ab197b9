#!/bin/bash
# A Slurm of one machine in the folder $work, which SLURM_CONF=$work/slurm.conf names. Read by tests/farm/slurm.sh.
# shellcheck disable=SC2154 # work is the reader's

# A port of loopback on which nothing listens.
free_port() {
    local port
    while :; do
        port=$((20000 + RANDOM % 10000))
        ! (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null && echo "$port" && return
    done
}

configure_cluster() {
    local host controller=1 node=1
    host=$(hostname -s)
    while ((controller == node)); do controller=$(free_port) node=$(free_port); done
    cat >"$SLURM_CONF" <<CONF
ClusterName=farm_test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$controller
SlurmdPort=$node
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
SlurmUser=root
SlurmdUser=root
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 RealMemory=500
PartitionName=usual Nodes=$host Default=YES PriorityTier=1
PartitionName=urgent Nodes=$host PriorityTier=10
CONF
}

# Whether SOMETHING is started by this test: its environment names this cluster.
ours() { grep -zqsFx "SLURM_CONF=$SLURM_CONF" "$1/environ"; }

start_cluster() {
    chmod 755 "$work" # munged wants others to reach its socket
    mkdir "$work/state" "$work/spool"
    (umask 077 && head -c 1024 /dev/urandom >"$work/munge.key")
    configure_cluster
    # Children of this shell, so that it can wait for their end.
    munged --foreground --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
        --seed-file="$work/munged.seed" --num-threads=2 >munged.log 2>&1 &
    until_true 10 "munged" test -S munge.socket
    slurmctld -D >/dev/null 2>&1 &
    slurmd -D >/dev/null 2>&1 &
    until_true 30 "a node that is idle" eval "sinfo -h -o %T | grep -qx idle"
}

# Requeued tasks are not eligible for two minutes: as if they were over. Once a second: each time Slurm thinks anew.
hurried=0
hurry_requeued() {
    local job reason
    ((SECONDS > hurried)) || return 0
    hurried=$SECONDS
    while read -r job reason; do
        [[ $reason != BeginTime ]] || scontrol update "JobId=$job" StartTime=now 2>/dev/null
    done < <(squeue -h -o '%i %r' 2>/dev/null)
}

dump() {
    squeue 2>&1
    tail -n 20 "$work"/*.log "$work"/*.parts/*.log 2>/dev/null
}

# Ends every process that was started with this cluster's configuration, daemons and jobs alike, and waits for their end.
stop_cluster() {
    local signal folder round left
    for signal in TERM KILL; do
        for round in {1..40}; do
            left=''
            for folder in /proc/[0-9]*; do
                if ! ours "$folder"; then continue; fi
                left=1
                ((round > 1)) || kill "-$signal" "${folder#/proc/}" 2>/dev/null
            done
            [[ $left ]] || break 2
            sleep 0.05
        done
    done
}
