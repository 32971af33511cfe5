"""Many sessions: in processes of this machine or on a cluster; the runner alone writes."""
