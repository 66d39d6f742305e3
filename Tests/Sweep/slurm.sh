# SPDX-License-Identifier: GPL-3.0-or-later
# A cluster of two nodes on this machine, as whoever calls it: munged, slurmctld and two slurmd, on 127.0.0.1 and ports of their own. Sourced;
# `$folder` is a folder of the caller's that goes afterwards, and end_cluster ends all of it.

# The Nth of this call's ports: other clusters on this machine have others.
port() { echo $((20000 + $$ % 10000 * 4 + $1)); }

start_munge() {
    chmod 711 "$folder" # munged wants everybody to find its socket
    mkdir -m 711 "$folder/munge"
    (umask 077; head -c 1024 /dev/urandom >"$folder/munge/key")
    munged --foreground --socket="$folder/munge/socket" --key-file="$folder/munge/key" --pid-file="$folder/munge/pid" \
        --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" --num-threads=2 2>"$folder/munge/said" &
    munge=$!
}

write_config() {
    user=$(id -un)
    cat >"$folder/slurm.conf" <<CONF
ClusterName=physvib
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$(port 0)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool.%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1
ReturnToService=2
SlurmdTimeout=5
KillWait=2
NodeName=one NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$(port 1) CPUs=1 State=UNKNOWN
NodeName=two NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$(port 2) CPUs=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
    mkdir "$folder/state"
    export SLURM_CONF="$folder/slurm.conf"
}

# start_node NAME: its daemon's number is in $node_NAME.
start_node() {
    mkdir -p "$folder/spool.$1"
    slurmd -D -N "$1" -f "$folder/slurm.conf" 2>"$folder/slurmd.$1.said" &
    eval "node_$1=$!"
}

# wait_for SECONDS COMMAND...: until it is true.
wait_for() {
    tries=$(($1 * 5))
    shift
    while ! "$@" >"$folder/tried" 2>&1; do
        tries=$((tries - 1))
        [ $tries -gt 0 ] || { echo "waited in vain for: $*"; cat "$folder/tried"; return 1; }
        sleep 0.2
    done
}

idle_nodes() { [ "$(sinfo -h -N -t idle -o %n | wc -l)" = 2 ]; }

start_cluster() {
    start_munge
    wait_for 30 munge --socket="$folder/munge/socket" -n
    write_config
    slurmctld -D -f "$folder/slurm.conf" 2>"$folder/slurmctld.said" &
    controller=$!
    start_node one
    start_node two
    wait_for 60 idle_nodes
}

# Daemons are ended by their numbers, steps by Slurm.
end_cluster() {
    scancel --user="$(id -un)" 2>/dev/null || true
    sleep 1
    for process in ${node_one:-} ${node_two:-} ${controller:-} ${munge:-}; do kill "$process" 2>/dev/null || true; done
    sleep 1
    for process in ${node_one:-} ${node_two:-} ${controller:-} ${munge:-}; do kill -9 "$process" 2>/dev/null || true; done
}
