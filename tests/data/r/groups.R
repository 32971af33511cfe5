# Two groups of people by rank sums, and carry-over in a mixed model, from base R and lmerTest.
# Run in this folder: Rscript groups.R. Writes groups.csv.
suppressPackageStartupMessages({library(lmerTest); library(pbkrtest)})

out <- data.frame(name = character(), value = numeric())
put <- function(name, value) out[nrow(out) + 1, ] <<- list(name, as.numeric(value))

# People's log times of one condition, and their log ratios of two: no ties, so base R is exact.
laps <- read.csv("laps_groups.csv")
laps$log_time <- log(laps$lap_time_s)
wide <- reshape(laps[, c("participant", "group", "condition", "log_time")], direction = "wide",
                idvar = c("participant", "group"), timevar = "condition")
ranked <- function(prefix, value) {
  w <- wilcox.test(value[wide$group == "b"], value[wide$group == "a"], exact = TRUE,
                   conf.int = TRUE)
  put(paste0(prefix, ".statistic"), w$statistic)
  put(paste0(prefix, ".p"), w$p.value)
  put(paste0(prefix, ".estimate"), w$estimate)
  put(paste0(prefix, ".low"), w$conf.int[1])
  put(paste0(prefix, ".high"), w$conf.int[2])
}
ranked("rank_sum.slower", wide$log_time.limited + 0.3 * (wide$group == "b"))
ranked("rank_sum.change", wide$log_time.model - wide$log_time.limited)

# With ties: every choice of who is in the group, of mid-ranks; twice the smaller tail.
item <- read.csv("item.csv")[1:14, ]
at <- which(item$reference > 2)
ranks <- rank(item$condition)
sums <- combn(nrow(item), length(at), function(chosen) sum(ranks[chosen]))
seen <- sum(ranks[at])
put("rank_sum.ties.p", min(1, 2 * min(mean(sums <= seen + 1e-9), mean(sums >= seen - 1e-9))))

# Carry-over: the condition of the lap before; a first lap has the mean of all of them.
square <- read.csv("laps_square.csv")
square <- square[order(square$participant, square$place), ]
square$before <- ave(square$condition, square$participant, FUN = function(x) c("", head(x, -1)))
square$condition <- relevel(factor(square$condition), ref = "limited")
for (c in c("baseline", "human", "model"))
  square[[c]] <- (square$before == c) + (square$before == "") / 4
square$place <- factor(square$place)
m <- lmer(log(lap_time_s) ~ condition + place + baseline + human + model + (1 | participant),
          square, control = lmerControl(optimizer = "bobyqa",
                                        optCtrl = list(rhoend = 1e-10, maxfun = 1e5)))
kr <- coef(summary(m, ddf = "Kenward-Roger"))
for (c in c("baseline", "human", "model")) {
  put(paste0("carry_over.", c, ".estimate"), kr[c, "Estimate"])
  put(paste0("carry_over.", c, ".se_kr"), kr[c, "Std. Error"])
  put(paste0("carry_over.", c, ".p"), kr[c, "Pr(>|t|)"])
}

out$value <- signif(out$value, 15)
write.csv(out, "groups.csv", row.names = FALSE, quote = FALSE)
