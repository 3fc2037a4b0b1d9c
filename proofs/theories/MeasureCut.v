(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Cutting rectangles out of rectangles: the rest of W outside of a set with inner content m has at most
   the area of W less m. *)
From Coq Require Import Reals Lra Lia List.
From Dyadel Require Import Plane Distance Measure.
Import ListNotations.
Open Scope R_scope.

(* The part of [lo,hi] in [p,q] is [clamp lo hi p, clamp lo hi q]. *)
Definition common (lo hi p q : R) : R := clamp lo hi q - clamp lo hi p.

(* The area of the part of M in Q. *)
Definition overlap (M Q : rect) : R :=
  common (xlo M) (xhi M) (xlo Q) (xhi Q) * common (ylo M) (yhi M) (ylo Q) (yhi Q).

Lemma clamp_cases lo hi t : clamp lo hi t = lo /\ (hi <= lo \/ t <= lo) \/ clamp lo hi t = hi /\ lo <= hi <= t \/
  clamp lo hi t = t /\ lo <= t <= hi.
Proof.
  unfold clamp, Rmin. destruct (Rle_dec hi t); unfold Rmax; destruct (Rle_dec lo _); lra.
Qed.

Ltac clamps := unfold common; repeat match goal with
  |- context [clamp ?a ?b ?c] => destruct (clamp_cases a b c) as [[-> ?] | [[-> ?] | [-> ?]]]; try lra end.

Lemma clamp_in lo hi t : lo <= hi -> lo <= clamp lo hi t <= hi.
Proof. intros H. apply (proj1 (clamp_spec lo hi t H)). Qed.

Lemma clamp_grows lo hi p q : p <= q -> clamp lo hi p <= clamp lo hi q.
Proof. intros. clamps. Qed.

Lemma common_nonneg lo hi p q : p <= q -> 0 <= common lo hi p q.
Proof. intros H. pose proof (clamp_grows lo hi p q H). unfold common. lra. Qed.

Lemma common_le lo hi p q : p <= q -> common lo hi p q <= q - p.
Proof. intros. clamps. Qed.

Lemma common_all lo hi p q : lo <= p -> p <= q -> q <= hi -> common lo hi p q = q - p.
Proof. intros. clamps. Qed.

(* Cutting [lo,hi] cuts the part in [p,q]. *)
Lemma clamp_split lo s hi p : lo <= s -> s <= hi -> clamp lo hi p = clamp lo s p + clamp s hi p - s.
Proof. intros. clamps. Qed.

Lemma common_split lo hi s t p q : lo <= s -> s <= t -> t <= hi ->
  common lo hi p q = common lo s p q + common s t p q + common t hi p q.
Proof.
  intros. unfold common. rewrite !(clamp_split lo s hi), !(clamp_split s t hi) by lra. ring.
Qed.

(* The part of the part. *)
Lemma common_positive lo hi s t p q : lo <= hi -> s <= t -> p <= q ->
  0 < common (clamp lo hi s) (clamp lo hi t) p q ->
  exists x, s < x < t /\ p < x < q.
Proof.
  intros H ST PQ P. set (u := clamp lo hi s) in *. set (v := clamp lo hi t) in *.
  exists ((clamp u v p + clamp u v q) / 2).
  assert (u <= v) by (apply clamp_grows, ST).
  pose proof (clamp_in u v p). pose proof (clamp_in u v q).
  assert (U : s <= u \/ u = hi) by (unfold u; clamps). assert (V : v <= t \/ v = lo) by (unfold v; clamps).
  assert (lo <= u <= hi) by (apply clamp_in, H). assert (lo <= v <= hi) by (apply clamp_in, H).
  clearbody u v. assert (A : p <= clamp u v p \/ clamp u v p = v) by clamps.
  assert (B : clamp u v q <= q \/ clamp u v q = u) by clamps.
  unfold common in P. lra.
Qed.

Lemma overlap_nonneg M Q : 0 <= overlap M Q.
Proof. apply Rmult_le_pos; apply common_nonneg; [apply x_ordered | apply y_ordered]. Qed.

Lemma overlap_le M Q : overlap M Q <= area Q.
Proof.
  apply Rmult_le_compat; try apply common_nonneg; try apply common_le; (apply x_ordered || apply y_ordered).
Qed.

(* M without the interior of Q: left, right, below, above; and the part of M in Q. *)
Section Cut.
Variables M Q : rect.
Let s := clamp (xlo M) (xhi M) (xlo Q).
Let t := clamp (xlo M) (xhi M) (xhi Q).
Let u := clamp (ylo M) (yhi M) (ylo Q).
Let v := clamp (ylo M) (yhi M) (yhi Q).

Definition left_part := Rect (xlo M) s (ylo M) (yhi M) (proj1 (clamp_in _ _ _ (x_ordered M))) (y_ordered M).
Definition right_part := Rect t (xhi M) (ylo M) (yhi M) (proj2 (clamp_in _ _ _ (x_ordered M))) (y_ordered M).
Definition middle := clamp_grows (xlo M) (xhi M) _ _ (x_ordered Q).
Definition lower_part := Rect s t (ylo M) u middle (proj1 (clamp_in _ _ _ (y_ordered M))).
Definition upper_part := Rect s t v (yhi M) middle (proj2 (clamp_in _ _ _ (y_ordered M))).
Definition common_part := Rect s t u v middle (clamp_grows (ylo M) (yhi M) _ _ (y_ordered Q)).
Definition cut : list rect := [left_part; right_part; lower_part; upper_part].

Lemma cut_covers z : inside z M -> ~ strictly z Q -> exists P, In P cut /\ inside z P.
Proof.
  intros [X Y] N. pose proof (clamp_in _ _ (xlo Q) (x_ordered M)) as S. pose proof (clamp_in _ _ (xhi Q) (x_ordered M)) as T.
  fold s in S. fold t in T.
  destruct (Rle_dec (fst z) s) as [L | L]; [exists left_part; unfold inside; simpl; intuition lra |].
  destruct (Rle_dec t (fst z)) as [R | R]; [exists right_part; unfold inside; simpl; intuition lra |].
  destruct (Rle_dec (snd z) u) as [D | D]; [exists lower_part; unfold inside; simpl; intuition lra |].
  destruct (Rle_dec v (snd z)) as [U | U]; [exists upper_part; unfold inside; simpl; intuition lra |].
  exfalso. apply N. unfold strictly. revert L R D U. unfold s, t, u, v. clamps.
Qed.

Lemma cut_within P z : In P cut -> strictly z P -> strictly z M /\ ~ inside z Q.
Proof.
  pose proof (clamp_in _ _ (xlo Q) (x_ordered M)). pose proof (clamp_in _ _ (xhi Q) (x_ordered M)).
  pose proof (clamp_in _ _ (ylo Q) (y_ordered M)). pose proof (clamp_in _ _ (yhi Q) (y_ordered M)).
  fold s in H. fold t in H0. fold u in H1. fold v in H2.
  intros [<- | [<- | [<- | [<- | []]]]] [X Y]; simpl in X, Y; (split; [unfold strictly; lra |]); intros [XQ YQ];
    [assert (s <= xlo Q \/ s = xlo M) by (unfold s; clamps) | assert (xhi Q <= t \/ t = xhi M) by (unfold t; clamps)
    | assert (u <= ylo Q \/ u = ylo M) by (unfold u; clamps) | assert (yhi Q <= v \/ v = yhi M) by (unfold v; clamps)];
    lra.
Qed.

Lemma cut_areas : areas cut = area M - overlap M Q.
Proof. unfold overlap, common, areas, cut, area. simpl. fold s t u v. ring. Qed.

Fixpoint overlaps (L : list rect) (P : rect) : R := match L with [] => 0 | K :: L' => overlap K P + overlaps L' P end.

Lemma cut_overlaps P : overlaps cut P = overlap M P - overlap common_part P.
Proof.
  assert (X : common (xlo M) (xhi M) (xlo P) (xhi P) = common (xlo M) s (xlo P) (xhi P)
    + common s t (xlo P) (xhi P) + common t (xhi M) (xlo P) (xhi P)).
  { apply common_split; [apply clamp_in, x_ordered | exact middle | apply clamp_in, x_ordered]. }
  assert (Y : common (ylo M) (yhi M) (ylo P) (yhi P) = common (ylo M) u (ylo P) (yhi P)
    + common u v (ylo P) (yhi P) + common v (yhi M) (ylo P) (yhi P)).
  { apply common_split; [apply clamp_in, y_ordered | apply clamp_grows, y_ordered | apply clamp_in, y_ordered]. }
  unfold overlaps, cut, overlap. simpl. rewrite X, Y. ring.
Qed.

Lemma apart_common P : apart Q P -> overlap common_part P = 0.
Proof.
  intros A. destruct (Rle_lt_or_eq_dec 0 _ (overlap_nonneg common_part P)) as [G | G]; [| now rewrite G].
  exfalso. unfold overlap in G. simpl in G.
  pose proof (common_nonneg s t _ _ (x_ordered P)). pose proof (common_nonneg u v _ _ (y_ordered P)).
  destruct (common_positive (xlo M) (xhi M) (xlo Q) (xhi Q) (xlo P) (xhi P)) as [x X]; try apply x_ordered.
  { fold s t. nra. }
  destruct (common_positive (ylo M) (yhi M) (ylo Q) (yhi Q) (ylo P) (yhi P)) as [y Y]; try apply y_ordered.
  { fold u v. nra. }
  apply (A (x, y)); unfold strictly; simpl; tauto.
Qed.
End Cut.

(* All of a list, and many cuts. *)
Definition cut_all (L : list rect) (Q : rect) : list rect := flat_map (fun M => cut M Q) L.
Fixpoint cut_by (L : list rect) (K : list rect) : list rect :=
  match K with [] => L | Q :: K' => cut_by (cut_all L Q) K' end.

Lemma overlaps_app K L P : overlaps (K ++ L) P = overlaps K P + overlaps L P.
Proof. induction K as [| Q K IH]; simpl; lra. Qed.

Lemma cut_all_areas L Q : areas (cut_all L Q) = areas L - overlaps L Q.
Proof.
  unfold cut_all. induction L as [| M L IH]; [simpl; ring |].
  change (flat_map _ (M :: L)) with (cut M Q ++ flat_map (fun N => cut N Q) L).
  rewrite areas_app, IH, cut_areas. simpl. ring.
Qed.

Lemma cut_all_overlaps L Q P : apart Q P -> overlaps (cut_all L Q) P = overlaps L P.
Proof.
  intros A. unfold cut_all. induction L as [| M L IH]; [reflexivity |].
  change (flat_map _ (M :: L)) with (cut M Q ++ flat_map (fun N => cut N Q) L).
  rewrite overlaps_app, IH, cut_overlaps, apart_common by exact A. simpl. ring.
Qed.

Lemma cut_all_overlaps_le L Q P : overlaps (cut_all L Q) P <= overlaps L P.
Proof.
  unfold cut_all. induction L as [| M L IH]; [simpl; lra |].
  change (flat_map _ (M :: L)) with (cut M Q ++ flat_map (fun N => cut N Q) L).
  rewrite overlaps_app, cut_overlaps. pose proof (overlap_nonneg (common_part M Q) P). simpl. lra.
Qed.

Lemma cut_by_covers K : forall L z, (exists M, In M L /\ inside z M) -> (forall Q, In Q K -> ~ strictly z Q) ->
  exists P, In P (cut_by L K) /\ inside z P.
Proof.
  induction K as [| Q K IH]; intros L z H N; [exact H |]. simpl. apply IH; [| intros P I; apply N; now right].
  destruct H as [M [I D]]. destruct (cut_covers M Q z D) as [P [J E]]; [apply N; now left |].
  exists P. split; [| exact E]. apply in_flat_map. now exists M.
Qed.

(* Rectangles that lie in those of the list, and do not overlap, take away all of their area. *)
Lemma cut_by_areas K : forall L, ForallOrdPairs apart K -> (forall Q, In Q K -> overlaps L Q = area Q) ->
  areas (cut_by L K) = areas L - areas K.
Proof.
  induction K as [| Q K IH]; intros L D H; [simpl; ring |]. inversion D as [| ? ? F D']; subst. simpl.
  rewrite IH; [| exact D' |].
  - rewrite cut_all_areas, (H Q) by now left. ring.
  - intros P I. rewrite cut_all_overlaps; [apply H; now right |]. rewrite Forall_forall in F. now apply F.
Qed.

(* A rectangle with its interior in W. *)
Lemma between_interval p q lo hi : p < q -> (forall x, p < x < q -> lo <= x <= hi) -> lo <= p /\ q <= hi.
Proof.
  intros H I. split.
  - apply Rnot_lt_le. intros C. pose proof (Rmin_l lo q). pose proof (Rmin_r lo q).
    assert (p < Rmin lo q) by (apply Rmin_glb_lt; lra). specialize (I ((p + Rmin lo q) / 2)). lra.
  - apply Rnot_lt_le. intros C. pose proof (Rmax_l hi p). pose proof (Rmax_r hi p).
    assert (Rmax hi p < q) by (apply Rmax_lub_lt; lra). specialize (I ((Rmax hi p + q) / 2)). lra.
Qed.

Lemma overlap_within W Q : within (fun z => inside z W) Q -> overlap W Q = area Q.
Proof.
  intros H. pose proof (x_ordered Q) as X. pose proof (y_ordered Q) as Y. unfold overlap, area.
  destruct (Req_dec (xlo Q) (xhi Q)) as [E | X']; [rewrite E; unfold common; ring |].
  destruct (Req_dec (ylo Q) (yhi Q)) as [E | Y']; [rewrite E; unfold common; ring |].
  destruct (between_interval (xlo Q) (xhi Q) (xlo W) (xhi W)) as [X1 X2]; [lra | |].
  { intros x D. apply (H (x, (ylo Q + yhi Q) / 2)). unfold strictly. simpl. lra. }
  destruct (between_interval (ylo Q) (yhi Q) (ylo W) (yhi W)) as [Y1 Y2]; [lra | |].
  { intros y D. apply (H ((xlo Q + xhi Q) / 2, y)). unfold strictly. simpl. lra. }
  rewrite !common_all by lra. reflexivity.
Qed.

Theorem content_rest W (A : point -> Prop) m : (forall z, A z -> inside z W) -> inner_ge A m ->
  content_le (fun z => inside z W /\ ~ A z) (area W - m).
Proof.
  intros I H e E. destruct (H e E) as [K [WK [D S]]]. exists (cut_by [W] K). split.
  - intros z [Z N]. apply cut_by_covers; [exists W; split; [now left | exact Z] |].
    intros Q J T. apply N. rewrite Forall_forall in WK. now apply (WK Q J).
  - rewrite cut_by_areas; [simpl; lra | exact D |]. intros Q J. simpl. rewrite Rplus_0_r. apply overlap_within.
    rewrite Forall_forall in WK. intros z Z. now apply I, (WK Q J).
Qed.
