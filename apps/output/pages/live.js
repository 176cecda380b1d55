"use strict";
// Follows a render that is under way, by the answers of its server (apps/live/page_server.h).

const duration = seconds => seconds < 60 ? `${Math.round(seconds)} s` : seconds < 3600 ? `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`
  : `${Math.floor(seconds / 3600)} h ${Math.round(seconds % 3600 / 60)} min`;
const progressText = ({ samples, seconds, fraction, seconds_left }) =>
  (samples ? `So far ${whole(samples)} samples a pixel` : "No samples yet") + (seconds === undefined ? "" : `, ${duration(seconds)}`) +
  (seconds_left === undefined ? "" : `; ${Math.round(100 * Math.min(1, fraction))}%, ${duration(seconds_left)} left`) + ".";
// The text that the server returns for the path; undefined if the server does not answer.
const fetched = async path => {
  try {
    return await (await fetch(path)).text();
  } catch {
    return undefined;
  }
};
// Asks the server for progress until the render ends. Calls take() whenever the data are newer than `version`; take() returns
// whether it got them. Calls tell() with a sentence about how far the render is, and
// with the server's answer.
const follow = async (version, take, tell) => {
  const page = Math.random().toString(36).slice(2);
  let hasAll = false;
  for (;;) {
    const text = await fetched(`progress?page=${page}&after=${version}`);
    if (text === undefined && hasAll) return;
    if (text === undefined) return tell("The render has ended without this page, which shows what there was until then.");
    const news = JSON.parse(text), isNew = news.version !== version;
    const hasIt = !isNew || await take();
    hasAll = hasIt && news.finished;
    if (hasIt) tell(news.finished ? `Finished.${news.file ? ` What this page shows is kept in ${news.file}` : ""}` : progressText(news), news);
    if (news.finished && !isNew) return;
    version = news.version;
  }
};
