# Lap times by condition, and what the limitation costs, from an export for R:
#
#   lad-study export studies/four-lap-seed0 --format r --out four-lap-r
#   Rscript examples/lap_times.R four-lap-r
#
arguments <- commandArgs(trailingOnly = TRUE)
folder <- if (length(arguments)) arguments[1] else "four-lap-r"
source(file.path(folder, "read.R"))

counted <- laps[!laps$practice & laps$completed, ]
cat(sprintf("%s by condition, in %s\n", "lap_time_s", attr(laps$lap_time_s, "unit")))
print(aggregate(lap_time_s ~ condition, data = counted,
                FUN = function(x) c(n = length(x), mean = mean(x), sd = sd(x))))

# Within participants: each one's limited lap against the same one's baseline.
wide <- reshape(counted[, c("participant", "condition", "lap_time_s")],
                idvar = "participant", timevar = "condition", direction = "wide")
difference <- wide$lap_time_s.limited - wide$lap_time_s.baseline
cat(sprintf("limited - baseline: %.3f s (n = %d)\n",
            mean(difference, na.rm = TRUE), sum(!is.na(difference))))
print(wilcox.test(difference, exact = FALSE))
