(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* An extreme centre of circles that meet three rectangles: each of the three is touched, one from outside, another one
   at its farthest corner [CEN-1]. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells.
Open Scope R_scope.

Section Three.
Variable B : sites.

(* Some circle about c meets all three. *)
Definition meets_all (c : point) : Prop := forall a b, (a < 3)%nat -> (b < 3)%nat -> ds c (B a) <= dl c (B b).

Lemma meets_all_radius c : meets_all c <-> exists r, forall a, (a < 3)%nat -> ds c (B a) <= r <= dl c (B a).
Proof.
  split; [| intros (r & H) a b Ha Hb; pose proof (H a Ha); pose proof (H b Hb); lra].
  intros H. destruct (finite_max (fun _ => True) (fun k => ds c (B k)) 3) as (m & Hm & _ & L); [now exists 0%nat; split; [lia |] |].
  exists (ds c (B m)). intros a A. split; [now apply L | now apply H].
Qed.

(* Farther on along the one axis, or as far and farther along the other. *)
Definition ahead (d : point) : Prop := 0 < fst d \/ fst d = 0 /\ 0 < snd d.
Definition step (o d : point) (t : R) : point := (fst o + t * fst d, snd o + t * snd d).

Lemma across_ahead n : exists d, ahead d /\ dot n d = 0.
Proof.
  destruct (Req_dec (snd n) 0) as [Z | Z].
  - exists (0, 1). split; [right; cbn; lra | unfold dot; cbn; lra].
  - exists (1, - fst n / snd n). split; [left; cbn; lra | unfold dot; cbn; field; exact Z].
Qed.

Lemma step_dist o d t : 0 <= t -> dist o (step o d t) = t * dist (0, 0) d.
Proof. apply dist_scaled. unfold dist2, step. cbn. ring. Qed.

(* A strict inequality holds near by, too. *)
Lemma strict_stays o d a b : ds o (B a) < dl o (B b) -> small (fun t => ds (step o d t) (B a) <= dl (step o d t) (B b)).
Proof.
  intros L. pose proof (dist_nonneg (0, 0) d) as D. set (e := (dl o (B b) - ds o (B a)) / (2 * (dist (0, 0) d + 1))).
  assert (E : 0 < e) by (unfold e; apply Rdiv_lt_0_compat; lra). exists e. split; [exact E |]. intros t [T Te].
  pose proof (ds_move (step o d t) o (B a)) as S. pose proof (dl_move o (step o d t) (B b)) as S'.
  rewrite dist_sym, step_dist in S by lra. rewrite step_dist in S' by lra.
  assert (M : t * dist (0, 0) d <= e * (dist (0, 0) d + 1)) by nra.
  assert (e * (dist (0, 0) d + 1) = (dl o (B b) - ds o (B a)) / 2) by (unfold e; field; lra). lra.
Qed.

(* Where both are equal, it stays across the line from the farthest place to the nearest. *)
Lemma equal_stays o d a b t : ds o (B a) = dl o (B b) ->
  dot (fst (nearest o (B a)) - fst (farthest o (B b)), snd (nearest o (B a)) - snd (farthest o (B b))) d = 0 ->
  ds (step o d t) (B a) <= dl (step o d t) (B b).
Proof.
  intros E D. set (q := nearest o (B a)) in *. set (s := farthest o (B b)) in *.
  apply Rle_trans with (dist (step o d t) q); [apply ds_le, nearest_inside |].
  apply Rle_trans with (dist (step o d t) s); [| apply le_dl, farthest_inside]. apply dist_le.
  assert (E2 : dist2 o q = dist2 o s) by (rewrite <- !dist_sq; unfold ds, dl in E; fold q s in E; rewrite E; reflexivity).
  unfold dot in D. cbn [fst snd] in D. unfold dist2, step in *. cbn [fst snd].
  assert (F : 2 * t * ((fst q - fst s) * fst d + (snd q - snd s) * snd d) = 0) by (rewrite D; ring). lra.
Qed.

(* A rectangle all of which is as far is a point. *)
Lemma one_distance o X : ds o X = dl o X -> nearest o X = farthest o X.
Proof.
  intros E. destruct (nearest_inside o X) as [Nx Ny]. destruct (farthest_inside o X) as [Fx Fy].
  set (q := nearest o X) in *. set (s := farthest o X) in *.
  assert (M : inside (mix (/ 2) q s) X) by (split; unfold mix; cbn [fst snd]; lra).
  pose proof (ds_le o X _ M) as L. assert (E1 : dist o q = dist o s) by exact E.
  assert (L2 : dist2 o q <= dist2 o (mix (/ 2) q s)) by (apply dist_le; exact L).
  assert (E2 : dist2 o q = dist2 o s) by (rewrite <- !dist_sq, E1; reflexivity).
  assert (Z : Rsqr (fst q - fst s) + Rsqr (snd q - snd s) <= 0).
  { unfold Rsqr, dist2, mix in *. cbn [fst snd] in *. nra. }
  pose proof (Rle_0_sqr (fst q - fst s)). pose proof (Rle_0_sqr (snd q - snd s)).
  destruct (Rplus_sqr_eq_0 (fst q - fst s) (snd q - snd s)) as [X1 Y1]; [lra |].
  rewrite (surjective_pairing q), (surjective_pairing s). f_equal; lra.
Qed.

Lemma some_step o d : (forall a b, (a < 3)%nat -> (b < 3)%nat -> small (fun t => ds (step o d t) (B a) <= dl (step o d t) (B b)))
  -> exists t, 0 < t /\ meets_all (step o d t).
Proof.
  intros H. destruct (small_finite (fun a t => forall b, (b < 3)%nat -> ds (step o d t) (B a) <= dl (step o d t) (B b)) 3) as
    (e & E & F).
  - intros a A. apply small_finite. intros b Hb. now apply H.
  - exists e. split; [exact E |]. intros a b A Hb. apply F; auto. lra.
Qed.

(* A centre with no other centre ahead of it: the circle touches all three, from outside or inside, and one of them from
   outside, another one from inside. *)
Theorem extreme_is_critical o : meets_all o -> (forall c, meets_all c -> ~ ahead (fst c - fst o, snd c - snd o)) ->
  exists r a b, (a < 3)%nat /\ (b < 3)%nat /\ a <> b /\ ds o (B a) = r /\ dl o (B b) = r /\
    forall k, (k < 3)%nat -> ds o (B k) = r \/ dl o (B k) = r.
Proof.
  intros O Last.
  assert (Stuck : forall d, ahead d -> ~ forall a b, (a < 3)%nat -> (b < 3)%nat -> a <> b ->
    small (fun t => ds (step o d t) (B a) <= dl (step o d t) (B b))).
  { intros d D H. destruct (some_step o d) as (t & T & M).
    - intros a b A Hb. destruct (Nat.eq_dec a b) as [-> | N]; [| now apply H]. exists 1. split; [lra |]. intros t _.
      apply ds_le_dl.
    - apply (Last _ M). unfold step. cbn [fst snd]. unfold ahead. cbn [fst snd].
      destruct D as [D | [D1 D2]]; [left | right]; replace (fst o + t * fst d - fst o) with (t * fst d) by ring.
      + now apply Rmult_lt_0_compat.
      + rewrite D1. split; [ring |]. replace (snd o + t * snd d - snd o) with (t * snd d) by ring.
        now apply Rmult_lt_0_compat. }
  destruct (classic (exists a b, (a < 3)%nat /\ (b < 3)%nat /\ a <> b /\ ds o (B a) = dl o (B b))) as
    [(a & b & A & Hb & N & E) | No].
  2: { exfalso. apply (Stuck (1, 0)); [left; cbn; lra |]. intros a b A Hb N. apply strict_stays.
       destruct (Rle_lt_or_eq_dec _ _ (O a b A Hb)) as [L | L]; [exact L |]. elim No. now exists a, b. }
  exists (ds o (B a)), a, b. do 3 (split; [assumption |]). split; [reflexivity |]. split; [now symmetry |]. intros k K.
  apply NNPP. intros Off.
  assert (Ka : k <> a) by (intros ->; apply Off; now left). assert (Kb : k <> b) by (intros ->; apply Off; right; now symmetry).
  assert (Sk : ds o (B k) < ds o (B a)).
  { destruct (Rle_lt_or_eq_dec _ _ (O k b K Hb)) as [L | L]; [lra |]. elim Off. left. lra. }
  assert (Lk : ds o (B a) < dl o (B k)).
  { destruct (Rle_lt_or_eq_dec _ _ (O a k A K)) as [L | L]; [exact L |]. elim Off. right. lra. }
  set (n := (fst (nearest o (B a)) - fst (farthest o (B b)), snd (nearest o (B a)) - snd (farthest o (B b)))).
  destruct (across_ahead n) as (d & D & Dn). apply (Stuck d D). intros x y X Y Nxy.
  destruct (Rle_lt_or_eq_dec _ _ (O x y X Y)) as [L | L]; [now apply strict_stays |].
  assert (Both : x = a /\ y = b \/ x = b /\ y = a).
  { assert (Three : forall z, (z < 3)%nat -> z = a \/ z = b \/ z = k) by lia.
    destruct (Three x X) as [-> | [-> | ->]]; destruct (Three y Y) as [-> | [-> | ->]]; try tauto; exfalso; try tauto.
    - lra.
    - pose proof (O b a Hb A). pose proof (O a b A Hb). pose proof (ds_le_dl o (B b)). lra.
    - pose proof (O a b A Hb). pose proof (ds_le_dl o (B a)). lra.
    - lra. }
  exists 1. split; [lra |]. intros t _. destruct Both as [[-> ->] | [-> ->]]; apply equal_stays; auto.
  pose proof (ds_le_dl o (B a)). pose proof (ds_le_dl o (B b)). assert (Da : ds o (B a) = dl o (B a)) by lra.
  assert (Db : ds o (B b) = dl o (B b)) by lra.
  rewrite (one_distance o (B b) Db), <- (one_distance o (B a) Da). unfold n, dot in *. cbn [fst snd] in *. lra.
Qed.
End Three.
